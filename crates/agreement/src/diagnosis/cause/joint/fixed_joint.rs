//! `fixed_joint_dropped`: the model omits one fixed joint of the reference model.

use congruent_kinematics::Pose;

use crate::diagnosis::hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let reference = &models.reference;
    let dropped = |joint: usize| {
        PoseHypothesis::edit(
            Cause::FixedJointDropped,
            FaultPlace::ReferenceJoints(vec![joint]),
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
