//! Limits of the actuators, as controllers and reports know them.

use congruent_description::{Joint, Robot};
use congruent_scenario::JointSettings;

/// The largest effort and speed of a joint's actuator; `f64::MAX` for none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ActuatorLimits {
    /// Largest effort, N m or N.
    pub effort: f64,
    /// Largest speed, rad/s or m/s.
    pub speed: f64,
}

impl ActuatorLimits {
    /// The limits of all joints: those of the description, unless the scenario has `enforce_limits = false`.
    pub fn for_joints(robot: &Robot, settings: &JointSettings) -> Vec<Self> {
        let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
        // Zero means unknown: exporters write it if they have no value.
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
