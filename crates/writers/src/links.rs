//! A robot taken apart into links and joints by name, and put together again.

use congruent_description::{JointParts, Link, Robot, RobotError};

/// The links and joints of a robot, which may be changed.
pub(crate) struct Parts {
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<JointParts>,
}

impl Parts {
    pub(crate) fn of_robot(robot: &Robot) -> Self {
        let parts = robot.joints().iter().map(|joint| JointParts {
            parent: robot.link(joint.parent).name.clone(),
            child: robot.link(joint.child).name.clone(),
            mimic: joint
                .mimic
                .map(|mimic| (robot.joint(mimic.master).name.clone(), mimic.multiplier, mimic.offset)),
            joint: joint.clone(),
        });
        Self { joints: parts.collect(), links: robot.links().to_vec() }
    }

    /// The robot; its links and joints have the order of the one that was taken apart.
    pub(crate) fn into_robot(self, name: &str) -> Result<Robot, RobotError> {
        Robot::new(name, self.links, self.joints)
    }
}
