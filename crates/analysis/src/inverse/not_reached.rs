//! Why a target is not reached.

use congruent_description::{ChainQ, RobotDescription};
use congruent_kinematics::{IkTarget, Pose, SerialChain};
use nalgebra::Point3;
use schemars::JsonSchema;
use serde::Serialize;

/// Why a target is not reached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "reason")]
pub enum NotReached {
    /// The target is farther from the first moving joint than the links are long together.
    OutOfReach {
        /// Distance of the target from the first moving joint.
        distance_m: f64,
        /// Largest distance from there that the links allow.
        reach_m: f64,
    },
    /// The position alone is reached, but not with this orientation.
    Orientation,
}

/// An upper bound of the reach of an arm.
pub(super) struct Reach {
    /// Where the first moving joint is.
    first_joint_in_base: Point3<f64>,
    /// The links behind it in a straight line, sliding joints fully extended; infinite if one has no range.
    reach_m: f64,
}

impl Reach {
    pub(super) fn new(description: &RobotDescription) -> Self {
        let robot = &description.robot;
        let chain = robot.chain(description.base, description.tip).unwrap_or_default();
        let moving =
            chain.iter().position(|&joint| robot.joint(joint).kind.is_movable()).unwrap_or(chain.len());
        let mut base_from_first = chain.first().map_or(Pose::identity(), |&first| {
            // The first joint may hang from another link of the body of `base`.
            let path = SerialChain::from_urdf(robot, description.base, robot.joint(first).parent);
            path.base_from_tip(&ChainQ::zeros(0)).unwrap_or(Pose::identity())
        });
        let mut reach_m = description.tip_from_tcp.map_or(0.0, |tool| tool.translation.vector.norm());
        for (at, &joint) in chain.iter().enumerate() {
            let joint = robot.joint(joint);
            if at <= moving {
                base_from_first = base_from_first * Pose::from(joint.parent_from_joint);
            } else {
                reach_m += joint.parent_from_joint.translation.vector.norm();
            }
            reach_m += joint.largest_shift_m();
        }
        Self { first_joint_in_base: Point3::from(base_from_first.translation), reach_m }
    }

    /// Whether no configuration brings the tool to a target, since it is too far away.
    pub(super) fn beyond(&self, target: &IkTarget) -> Option<NotReached> {
        let target_in_base = Point3::from(target.base_from_tcp.translation);
        let distance_m = (target_in_base - self.first_joint_in_base).norm();
        let Self { reach_m, .. } = *self;
        (distance_m > reach_m).then_some(NotReached::OutOfReach { distance_m, reach_m })
    }
}
