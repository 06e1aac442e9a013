//! `parameter` in the reference model: quarter turns that its file writes with too few digits.

use nalgebra::Matrix3;

use crate::diagnosis::{
    hypothesis::{Cause, Hypothesis, ModelPair, Place},
    reference_model::ReferenceModel,
    thresholds::{FOUR_DECIMALS_RAD, NO_TURN},
};

pub(super) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    let rounded = rounded(&models.reference);
    let all = (rounded.len() > 1).then(|| hypothesis(rounded.clone()));
    all.into_iter().chain(rounded.iter().map(|&joint| hypothesis(vec![joint]))).collect()
}

fn hypothesis(joints: Vec<usize>) -> Hypothesis {
    Hypothesis::edit(
        Cause::Parameter,
        Place::ReferenceJoints(joints.clone()),
        move |models: &mut ModelPair| {
            for &joint in &joints {
                let rotation = &mut models.reference.joints[joint].parent_from_joint.rotation;
                if let Some(exact) = quarter_turns(rotation) {
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
            && quarter_turns(rotation).is_some_and(|exact| (exact - rotation).amax() > NO_TURN)
    };
    (0..reference.joints.len()).filter(near).collect()
}

fn quarter_turns(rotation: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let exact = rotation.map(f64::round);
    ((exact - rotation).amax() < FOUR_DECIMALS_RAD && (exact.determinant() - 1.0).abs() < 0.5)
        .then_some(exact)
}
