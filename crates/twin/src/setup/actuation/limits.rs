//! What actuators can do, as controllers and reports know it.

use congruent_description::{Joint, Robot};

use crate::scenario::JointSettings;

/// The largest effort and speed of a joint's actuator; `f64::MAX` for none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ActuatorLimits {
    /// N m or N.
    pub(crate) effort: f64,
    /// rad/s or m/s.
    pub(crate) speed: f64,
}

impl ActuatorLimits {
    /// Of all joints: those of the description, if the scenario has its actuators keep them.
    pub(crate) fn of(robot: &Robot, settings: &JointSettings) -> Vec<Self> {
        let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        // Zero is what descriptions write for unknown.
        let kept = |value: Option<f64>| {
            value.filter(|&value| settings.enforce_limits && value > 0.0).unwrap_or(f64::MAX)
        };
        let limits = |joint: &Joint| Self {
            effort: kept(joint.limit.and_then(|limit| limit.effort)),
            speed: kept(joint.limit.and_then(|limit| limit.velocity)),
        };
        joints.map(limits).collect()
    }
}
