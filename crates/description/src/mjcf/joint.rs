//! The values of a joint: kind, axis, limits, losses.

use congruent_mjcf::{MjActuator, MjEffort, MjJoint, MjJointKind, MjModel, MjTarget};
use congruent_robot::{Joint, JointKind, JointLimit, JointParts};

use super::rounding::of_values;

/// Ranges from here on stand for "no limit"; squares of such positions overflow. Unit: rad or m; kind: range of numbers.
const UNLIMITED: f64 = 1e30;

/// A joint whose frame is known, with the other values of a hinge or a slide.
pub(super) fn with_values(frame: JointParts, model: &MjModel, number: usize) -> JointParts {
    let joint = &model.joints[number];
    let range = joint.range.as_ref().map(|range| range.value).filter(is_limit);
    let kind = match (joint.kind, range) {
        (MjJointKind::Slide, _) => JointKind::Prismatic,
        (_, Some(_)) => JointKind::Revolute,
        (_, None) => JointKind::Continuous,
    };
    // A slide without a range has no limit at all: the two ends that a limit needs would not be true.
    let [lower, upper] = range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
    let has_limit = range.is_some() || kind == JointKind::Continuous;
    let limit = JointLimit { lower, upper, effort: effort(joint), ..JointLimit::default() };
    let value_rounding = of_values(joint);
    let joint = Joint {
        kind,
        axis_in_joint: joint.axis_in_body.value,
        limit: has_limit.then_some(limit),
        damping: joint.damping.value[0] + sum_of_actuators(model, number, |of| of.damping),
        friction: joint.friction_loss.value,
        // A joint without the attribute has an armature of 0 in MuJoCo: every MJCF states it.
        armature: Some(joint.armature.value + sum_of_actuators(model, number, |of| of.armature)),
        value_rounding,
        ..frame.joint
    };
    JointParts { joint, ..frame }
}

fn is_limit([lower, upper]: &[f64; 2]) -> bool {
    lower.abs() < UNLIMITED && upper.abs() < UNLIMITED
}

/// The largest effort; `None` if it is not known.
fn effort(joint: &MjJoint) -> Option<f64> {
    match joint.effort {
        MjEffort::Within { range: [lower, upper], .. } => Some(upper.max(-lower)),
        MjEffort::Unactuated | MjEffort::Unlimited | MjEffort::ThroughTendon => None,
    }
}

/// The damping or armature that actuators of MuJoCo 4.0 add to their joint, gears included.
fn sum_of_actuators(model: &MjModel, joint: usize, term: impl Fn(&MjActuator) -> f64) -> f64 {
    let own = model.actuators.iter().filter(|actuator| actuator.target == MjTarget::Joint(joint));
    // Adding zero makes the sum of nothing, which is -0.0, plain zero.
    own.map(term).sum::<f64>() + 0.0
}
