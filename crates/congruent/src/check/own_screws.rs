//! The one screw of a robot file that differs from those of another description, as its cause.

use std::sync::Arc;

use congruent_agreement::{
    SourcePair,
    compare::CheckReport,
    diagnosis::Cause,
    report::{Fault, ReportedCause, ReportedDiagnosis, ReportedValue},
};
use congruent_description::{JointIndex, OwnModelForm, RobotDescription, Tolerance};
use congruent_input::{Diagnostic, line_column, number::significant_components};
use congruent_kinematics::{PoseError, ScrewTree, Twist};
use nalgebra::Vector3;

/// Replaces the diagnosis of a difference by the screw that explains it, if one of the two is screws without a URDF and all but one
/// of its screws, and the pose of the tip at zero, are those of the other. `compared` are the two in the same variables.
///
/// Frames of links move with the screw of a joint, so that compared by frames one wrong screw would be two wrong origins.
pub(super) fn diagnose_by_screw(
    geometry: &mut CheckReport,
    written: [&RobotDescription; 2],
    compared: [&RobotDescription; 2],
) {
    if !geometry.poses_disagree() {
        return;
    }
    for of in [0, 1] {
        // Screws of a function have no lines to name.
        if written[of].own_model() != Some(OwnModelForm::Screws) || written[of].is_loaded() {
            continue;
        }
        if let Some(diagnosis) = diagnosed(written[of], [compared[of], compared[1 - of]]) {
            replace_diagnosis(geometry, diagnosis);
            return;
        }
    }
}

/// Puts a diagnosis of the two descriptions in the place of the one that the report has.
pub(super) fn replace_diagnosis(geometry: &mut CheckReport, diagnosis: ReportedDiagnosis) {
    let others = std::mem::take(&mut geometry.diagnoses);
    let others = others.into_iter().filter(|of| of.name != SourcePair::UrdfOther);
    geometry.set_diagnoses(std::iter::once(diagnosis).chain(others).collect());
}

/// The cause, if it is one screw.
fn diagnosed(written: &RobotDescription, [own, other]: [&RobotDescription; 2]) -> Option<ReportedDiagnosis> {
    let trees = [&own.robot, &other.robot].map(ScrewTree::new);
    let tip = other.robot.find_link(&own.robot.link(own.tip).name)?;
    let [home, expected_home] = [*trees[0].home(own.tip), *trees[1].home(tip)];
    if !PoseError::between(&home, &expected_home).is_within(&own.tolerance) {
        return None;
    }
    let base_from_root = trees[0].home(own.base).inverse();
    let mut wrong: Option<(JointIndex, [Twist; 2])> = None;
    for &joint in own.robot.movable_joints() {
        let there = other.robot.find_joint(&own.robot.joint(joint).name)?;
        let twists = [trees[0].screw(joint)?, trees[1].screw(there)?];
        let twists = twists.map(|screw| screw.twist().transformed_by(&base_from_root));
        if !is_same(twists, &own.tolerance) && wrong.replace((joint, twists)).is_some() {
            return None;
        }
    }
    let (joint, twists) = wrong?;
    fault(written, &own.robot.joint(joint).name, twists)
}

fn is_same([own, other]: [Twist; 2], tolerance: &Tolerance) -> bool {
    (own.angular - other.angular).norm() <= tolerance.orientation_rad
        && (own.linear - other.linear).norm() <= tolerance.position_m
}

fn fault(written: &RobotDescription, joint: &str, twists: [Twist; 2]) -> Option<ReportedDiagnosis> {
    let places = written.places.own_model.as_ref()?;
    let span = places.joint(joint)?;
    let source = Arc::clone(places.source());
    let line = line_column(&source.text, span.start).0;
    let vector = |of: Vector3<f64>| significant_components(of.into()).join(", ");
    let [found, expected] =
        twists.map(|of| format!("omega = [{}], v_m = [{}]", vector(of.angular), vector(of.linear)));
    let message = format!("joint \"{joint}\": the screw in the base is {found}, expected {expected}");
    let suggestion = format!("in the base, joint \"{joint}\" has {expected}");
    let finding = Diagnostic::error(Cause::JointAxis.code(), message.clone()).at(span).in_file(&source);
    let fault = Fault {
        cause: Cause::JointAxis,
        joint: Some(joint.to_owned()),
        parameter: Some("omega, v_m".to_owned()),
        found: Some(ReportedValue::Text(found)),
        expected: Some(ReportedValue::Text(expected)),
        file: Some(source.path.display().to_string()),
        line: Some(line),
        message,
        suggestion: suggestion.clone(),
        ..Fault::default()
    };
    // All other screws and the tip at zero are equal, so nothing remains.
    let cause = ReportedCause {
        fault,
        residual_m: 0.0,
        residual_rad: 0.0,
        within_tolerance: true,
        parts: Vec::new(),
        stages: Vec::new(),
    };
    let pair = SourcePair::UrdfOther;
    Some(ReportedDiagnosis {
        name: pair,
        title: pair.title(),
        causes: vec![cause],
        indistinguishable: Vec::new(),
        invariants: Vec::new(),
        table: None,
        corrected: None,
        findings: vec![finding.with_help(suggestion)],
    })
}
