//! The links and joints of two robots that are the same: the child of a moving joint by the name of the joint, other
//! links by their own name.

use congruent_description::{Joint, JointIndex, LinkIndex, Robot, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, UrdfTree};

use crate::link_names::same_link;

/// A robot and another description of it, with the poses of the links of the first at zero by both. Both have the same
/// moving joints by name.
#[derive(Debug, Clone)]
pub struct MatchedRobots<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The other description of it.
    pub other: &'a Robot,
    /// For each link of the robot the same link of the other, if it has one.
    links: Vec<Option<LinkIndex>>,
    /// For each link of the robot the joint of the other with the name of the joint that carries it.
    namesakes: Vec<Option<JointIndex>>,
    /// Poses of the robot's links at zero: by its own description, and by the other.
    at_zero: [Vec<Pose>; 2],
}

impl<'a> MatchedRobots<'a> {
    /// The match; `poses` are those of the other description, at the links of the robot.
    ///
    /// # Errors
    /// [`LinkPosesError`] if a source rejects position zero.
    pub fn new([robot, other]: [&'a Robot; 2], poses: &mut dyn LinkPoses) -> Result<Self, LinkPosesError> {
        let namesake = |link| other.find_joint(&robot.joint(robot.parent_joint(link)?).name);
        let namesakes: Vec<Option<JointIndex>> = robot.link_indices().map(namesake).collect();
        let links = robot.link_indices().map(|link| same_link(link, robot, other)).collect();
        let mut at_zero = [(); 2].map(|()| vec![Pose::identity(); robot.links().len()]);
        let zero = RobotQ::zeros(robot.dof());
        UrdfTree::new(robot).root_from_links_into(&zero, &mut at_zero[0])?;
        poses.root_from_links_into(&zero, &mut at_zero[1])?;
        Ok(Self { robot, other, links, namesakes, at_zero })
    }

    /// The match with another robot that differs only in values of its joints.
    ///
    /// # Panics
    /// If the robot has other links or joints.
    #[must_use]
    pub fn with<'b>(&self, robot: &'b Robot) -> MatchedRobots<'b>
    where
        'a: 'b,
    {
        // Only the poses of its own side change; names and matches stay.
        let mut changed = MatchedRobots { robot, ..self.clone() };
        let zero = RobotQ::zeros(robot.dof());
        UrdfTree::new(robot)
            .root_from_links_into(&zero, &mut changed.at_zero[0])
            .expect("the same links and joints");
        changed
    }

    /// The link of the other description that is the same as this one.
    pub(crate) fn link_there(&self, link: LinkIndex) -> Option<LinkIndex> {
        self.links[link.get()]
    }

    /// Whether the other description has this link; the poses of one that it lacks follow those before it.
    pub fn is_matched(&self, link: LinkIndex) -> bool {
        self.links[link.get()].is_some()
    }

    /// Pose of a link at zero by the own description.
    pub fn own(&self, link: LinkIndex) -> Pose {
        self.at_zero[0][link.get()]
    }

    /// Pose of a link at zero by the other description.
    pub fn there(&self, link: LinkIndex) -> Pose {
        self.at_zero[1][link.get()]
    }

    /// The joint of the other description that carries the same link from the same link.
    pub fn same_joint(&self, joint: &Joint) -> Option<&'a Joint> {
        let there = self.other.joint(self.other.parent_joint(self.links[joint.child.get()]?)?);
        (Some(there.parent) == self.links[joint.parent.get()]).then_some(there)
    }

    /// The joint of the other description with the same name.
    pub fn namesake(&self, joint: &Joint) -> Option<&'a Joint> {
        Some(self.other.joint(self.namesakes[joint.child.get()]?))
    }

    /// The joint that carries a link which the other description lacks; it is fixed.
    pub fn unmatched_joint(&self, link: LinkIndex) -> Option<JointIndex> {
        if self.is_matched(link) { None } else { self.robot.parent_joint(link) }
    }

    /// The largest distance of a link from the root at zero, m; 1 if all are there.
    pub fn reach_m(&self) -> f64 {
        let reach = self.at_zero[0].iter().map(|pose| pose.translation.norm()).fold(0.0, f64::max);
        if reach > 0.0 { reach } else { 1.0 }
    }
}
