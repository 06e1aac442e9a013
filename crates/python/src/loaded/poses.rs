//! The chain that the poses of a function show: screws that are identified from them, and the robot of these screws.

use std::sync::Arc;

use congruent::{
    description::{ChainQ, Joint, RobotDescription, SmallMotion, Tolerance, load_opened_robot},
    input::SourceFile,
    kinematics::{Pose, PoseError, ScrewChain, Twist},
    nalgebra::{Matrix3, Vector3},
};
use pyo3::prelude::*;

use crate::{
    error::refused,
    robot::{PythonRobot, access},
    spatial::matrix,
};

/// A screw may be off by more than poses are, whose errors it is computed from. Kind: choice.
const SEVERAL_TIMES: f64 = 3.0;

/// A homogeneous matrix.
type Matrix = [[f64; 4]; 4];
/// Twists at zero, `base_from_tip` at zero, and the largest distance and angle from the poses of the function.
type Identified = (Vec<[f64; 6]>, Matrix, (f64, f64));

/// The screws of a chain, angular before linear, its pose at zero, and how far these are from the function ``base_from_tip`` at the given
/// configurations: nothing if each joint is a pure turn or shift.
///
/// It is asked around ``middle`` and nowhere farther from it than some 1.3 times ``half``, since a function may have limits.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python gives no lists that could be borrowed")]
pub(crate) fn identified_screws(
    base_from_tip: &Bound<'_, PyAny>,
    middle: Vec<f64>,
    half: Vec<f64>,
    configurations: Vec<Vec<f64>>,
) -> PyResult<Identified> {
    let ask = |q: &[f64]| -> PyResult<Pose> {
        let matrix: Matrix = base_from_tip.call1((q.to_vec(),))?.extract()?;
        Ok(pose(&matrix))
    };
    let mut raised = None;
    let scaled = ScrewChain::identify(middle.len(), |q| {
        if raised.is_some() {
            return Pose::identity();
        }
        // `identify` takes a function without errors: the first is kept and raised after it.
        let q: Vec<f64> =
            q.iter().zip(&half).zip(&middle).map(|((q, half), middle)| middle + half * q).collect();
        ask(&q).unwrap_or_else(|error| {
            raised = Some(error);
            Pose::identity()
        })
    });
    if let Some(error) = raised {
        return Err(error);
    }
    let chain = at_zero(&scaled, &middle, &half);
    let mut worst = PoseError::default();
    for q in configurations {
        let expected = chain.base_from_tip(&q.iter().copied().collect::<ChainQ>());
        let expected = expected.expect("the caller gives as many positions as joints");
        worst = worst.larger(PoseError::between(&ask(&q)?, &expected));
    }
    let twists = chain.twists_in_base.iter();
    let twists = twists.map(|twist| {
        let [x, y, z]: [f64; 3] = twist.angular.into();
        let [u, v, w]: [f64; 3] = twist.linear.into();
        [x, y, z, u, v, w]
    });
    Ok((twists.collect(), matrix(&chain.base_from_tip_at_zero), (worst.position_m, worst.orientation_rad)))
}

/// The robot of a ``robot.toml`` with screws that were identified, under the name that messages have for it. ``residual`` is how far the
/// poses of the function are from it, in m and rad.
#[pyfunction]
pub(crate) fn robot_of_screws(
    py: Python<'_>,
    text: &str,
    name: &str,
    residual: (f64, f64),
) -> PyResult<PythonRobot> {
    let source = SourceFile { path: "poses.toml".into(), text: text.to_owned(), is_foreign: false };
    let read = access().and_then(|access| load_opened_robot(&Arc::new(source), &access));
    let read = read.map_err(|findings| refused(py, findings))?;
    let within = Tolerance { position_m: residual.0, orientation_rad: residual.1 };
    let described = RobotDescription {
        robot: read.robot.with_joints(|joint| joint.rounding.origin = of_residual(joint, within)),
        path: name.into(),
        urdf_path: name.into(),
        loaded: Some(within),
        warnings: Vec::new(),
        ..read
    };
    PythonRobot::along(py, described, None, None)
}

/// The chain whose variables are 0 where those of `scaled` are `-middle / half`: `exp(S (q - c) / h)` is `exp(S/h q) exp(-S c/h)`, and
/// the second factor moves all that follows.
fn at_zero(scaled: &ScrewChain, middle: &[f64], half: &[f64]) -> ScrewChain {
    let mut before = Pose::identity();
    let mut twists_in_base = Vec::with_capacity(middle.len());
    for ((scaled, middle), half) in scaled.twists_in_base.iter().zip(middle).zip(half) {
        let own = Twist { angular: scaled.angular / *half, linear: scaled.linear / *half };
        twists_in_base.push(own.transformed_by(&before));
        before = before * own.exp(-middle);
    }
    ScrewChain { twists_in_base, base_from_tip_at_zero: before * scaled.base_from_tip_at_zero }
}

/// How far a joint may be from its place by a residual, in the terms of the digits of a file. Sums of joints may be off by less than each.
fn of_residual(joint: &Joint, Tolerance { position_m, orientation_rad }: Tolerance) -> Vec<SmallMotion> {
    let at = joint.parent_from_joint.translation.vector;
    let axes = [0, 1, 2].map(|axis| Vector3::ith(axis, SEVERAL_TIMES));
    let shifts = axes.iter().map(|axis| SmallMotion::shift(axis * position_m));
    let turns = axes.iter().map(|axis| SmallMotion::turn(axis * orientation_rad, &at));
    shifts.chain(turns).collect()
}

fn pose(matrix: &Matrix) -> Pose {
    Pose {
        rotation: Matrix3::from_fn(|row, column| matrix[row][column]),
        translation: Vector3::from_fn(|row, _| matrix[row][3]),
    }
}
