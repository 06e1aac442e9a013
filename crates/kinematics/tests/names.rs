//! The names of enums in answers, by serde.

use std::fmt::Debug;

use congruent_kinematics::{
    AxisRelation, Choice, DeterminedAngles, DifferentialMethod, EulerSet, IkMethod, JacobianKind, TargetPart,
};
use serde::Serialize;

#[track_caller]
fn check<T: Serialize + Debug>(variants: &[T], names: &[&str]) {
    let found: Vec<String> = variants.iter().map(|each| serde_json::to_string(each).unwrap()).collect();
    let expected: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    assert_eq!(found, expected, "{variants:?}");
}

#[test]
fn enums_name_themselves() {
    use AxisRelation::{AntiParallel, Coincident, Intersecting, Parallel, Skew};
    use Choice::{CoincidentFrame, FirstFrame, LastFrame, NormalSense, ParallelOrigin, PrismaticLine};
    check(
        &[IkMethod::LevenbergMarquardt, IkMethod::Newton, IkMethod::PseudoInverse, IkMethod::Transpose],
        &["lm", "newton", "pseudo-inverse", "transpose"],
    );
    check(
        &[DifferentialMethod::PseudoInverse, DifferentialMethod::Transpose],
        &["pseudo_inverse", "transpose"],
    );
    check(&[TargetPart::Position, TargetPart::Pose], &["position", "pose"]);
    check(
        &[JacobianKind::Space, JacobianKind::Body, JacobianKind::Geometric],
        &["space", "body", "geometric"],
    );
    check(
        &[Skew, Intersecting, Parallel, AntiParallel, Coincident],
        &["skew", "intersecting", "parallel", "anti_parallel", "coincident"],
    );
    check(
        &[FirstFrame, ParallelOrigin, NormalSense, CoincidentFrame, PrismaticLine, LastFrame],
        &[
            "first_frame",
            "parallel_origin",
            "normal_sense",
            "coincident_frame",
            "prismatic_line",
            "last_frame",
        ],
    );
    check(
        &[DeterminedAngles::Both, DeterminedAngles::Sum, DeterminedAngles::Difference],
        &["both", "sum", "difference"],
    );
    check(&EulerSet::ALL, &EulerSet::ALL.map(EulerSet::name));
}
