//! A fixed joint that the table lacks, as the declared transform that the table would have with it.

use congruent_description::ChainQ;
use congruent_kinematics::Pose;

use super::{
    explanation::Explanation,
    hypothesis::{Cause, FaultPlace, ModelPair},
    thresholds::SAME_VALUE,
};

/// The explanation with each dropped joint before the first moving one in the candidate's base, and each behind the last
/// one in its tool. A joint between moving ones has no such place and stays in the reference model.
pub(crate) fn with_dropped_joints(models: &ModelPair, explanation: &Explanation) -> Explanation {
    let mut explanation = explanation.clone();
    let Explanation { faults, corrected: ModelPair { candidate, reference }, .. } = &mut explanation;
    for fault in faults.iter_mut().filter(|fault| fault.cause == Cause::FixedJointDropped) {
        let FaultPlace::ReferenceJoints(joints) = &fault.place else { continue };
        let without = reference.clone();
        for &joint in joints {
            reference.joints[joint] = models.reference.joints[joint];
        }
        let motions = generic(reference.joint_count());
        let [with, without] =
            [&*reference, &without].map(|model| motions.each_ref().map(|q| model.base_from_tip(q)));
        // What the joint adds is the same at every configuration on one side of the chain alone.
        let before = same([with[0] * without[0].inverse(), with[1] * without[1].inverse()]);
        let behind = same([without[0].inverse() * with[0], without[1].inverse() * with[1]]);
        if let Some(added) = before {
            candidate.base = (added * candidate.base.pose).into();
            fault.place = FaultPlace::Base;
        } else if let Some(added) = behind {
            candidate.tool = (candidate.tool.pose * added).into();
            fault.place = FaultPlace::Tool;
        }
    }
    explanation
}

/// Two configurations at which all joints are elsewhere.
fn generic(joints: usize) -> [ChainQ; 2] {
    #[expect(clippy::cast_precision_loss, reason = "chains have few joints")]
    let at = |first: f64, step: f64| (0..joints).map(|joint| first + step * joint as f64).collect();
    [at(0.3, 0.17), at(-0.8, 0.29)]
}

fn same([one, other]: [Pose; 2]) -> Option<Pose> {
    (one.distance_m(&other) < SAME_VALUE && one.angle_rad(&other) < SAME_VALUE).then_some(one)
}
