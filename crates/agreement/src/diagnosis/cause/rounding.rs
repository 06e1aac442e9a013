//! `parameter` in the reference model: quarter turns that its file writes with too few digits.

use std::f64::consts::FRAC_PI_2;

use congruent_kinematics::EulerSet;
use nalgebra::Matrix3;

use super::rpy::rpy_from_rotation;

use crate::diagnosis::{
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
    reference_model::ReferenceModel,
    thresholds::{NO_TURN, ROUNDED_QUARTER_RAD},
};

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let rounded = rounded(&models.reference);
    // All together first: a file that rounds one quarter turn mostly rounds every one.
    let all = (rounded.len() > 1).then(|| hypothesis(rounded.clone()));
    all.into_iter().chain(rounded.iter().map(|&joint| hypothesis(vec![joint]))).collect()
}

fn hypothesis(joints: Vec<usize>) -> PoseHypothesis {
    PoseHypothesis::edit(
        Cause::Parameter,
        FaultPlace::ReferenceJoints(joints.clone()),
        move |models: &mut ModelPair| {
            for &joint in &joints {
                let rotation = &mut models.reference.joints[joint].parent_from_joint.rotation;
                if let Some(exact) = exact(rotation) {
                    *rotation = exact;
                }
            }
        },
    )
}

/// Joints whose rotation is nearly, but not exactly, a rotation by quarter turns.
fn rounded(reference: &ReferenceModel) -> Vec<usize> {
    let near = |&joint: &usize| {
        let rotation = &reference.joints[joint].parent_from_joint.rotation;
        reference.joints[joint].is_written
            && exact(rotation).is_some_and(|exact| (exact - rotation).amax() > NO_TURN)
    };
    (0..reference.joints.len()).filter(near).collect()
}

/// The rotation that is meant: by quarter turns, or with quarter turns among its roll, pitch and yaw.
fn exact(rotation: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let rpy = rpy_from_rotation(rotation);
    // A small angle is no rounded 0, which has no digits to lose. Where the pitch is a quarter turn, roll and yaw are not defined.
    let is_small = |angle: f64| angle.abs() > NO_TURN && angle.abs() < ROUNDED_QUARTER_RAD;
    let has_small = libm::cos(rpy[1]).abs() > ROUNDED_QUARTER_RAD && rpy.into_iter().any(is_small);
    // A rotation by quarter turns first: its rpy may be singular, and the entries decide more exactly.
    quarter_turns(rotation).filter(|_| !has_small).or_else(|| {
        let meant = rpy.map(|angle| {
            let quarters = (angle / FRAC_PI_2).round() * FRAC_PI_2;
            let is_rounded = (quarters - angle).abs() < ROUNDED_QUARTER_RAD && !is_small(angle);
            if is_rounded { quarters } else { angle }
        });
        let [roll, pitch, yaw] = meant;
        meant
            .iter()
            .zip(rpy)
            .any(|(meant, angle)| (meant - angle).abs() > NO_TURN)
            .then(|| EulerSet::Zyx.rotation([yaw, pitch, roll]))
    })
}

fn quarter_turns(rotation: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let exact = rotation.map(f64::round);
    // Rounded entries can also form a reflection or a singular matrix; only determinant 1 is a rotation.
    ((exact - rotation).amax() < ROUNDED_QUARTER_RAD && (exact.determinant() - 1.0).abs() < 0.5)
        .then_some(exact)
}
