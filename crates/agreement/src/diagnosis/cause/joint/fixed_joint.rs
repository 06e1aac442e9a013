//! `fixed_joint_dropped`: the model leaves out one fixed joint of the reference model.

use congruent_kinematics::Pose;

use crate::diagnosis::hypothesis::{Cause, Hypothesis, ModelPair, Place};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    let reference = &models.reference;
    let dropped = |joint: usize| {
        Hypothesis::edit(
            Cause::FixedJointDropped,
            Place::ReferenceJoints(vec![joint]),
            move |models: &mut ModelPair| models.reference.joints[joint].parent_from_joint = Pose::identity(),
        )
    };
    let is_fixed = |&joint: &usize| {
        reference.joints[joint].is_written
            && reference.joints[joint].twist_in_joint.is_none()
            && !reference.is_identity(joint)
    };
    (0..reference.joints.len()).filter(is_fixed).map(dropped).collect()
}
