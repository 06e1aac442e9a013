//! The poses of another description at the links of a robot.

use congruent_description::{Link, LinkIndex, Robot, RobotDescription, RobotQ};
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, PoseError, UrdfTree, sample_configurations};
use congruent_mapping::{MatchedRobots, same_link};

/// Random positions at which links are found to move alike. Kind: choice.
pub(super) const POSITIONS: usize = 50;

/// The poses of another description at the links of a robot; both have the same moving joints by name.
pub(super) struct PosesOfOther {
    tree: UrdfTree,
    links: Vec<LinkCorrespondence>,
    /// For each link its pose in the link where it is found.
    there_from_links: Vec<Pose>,
    /// Coordinate of the robot for each coordinate of the other description, by the name of the joint.
    coordinates: Vec<usize>,
    /// The other robot if its mimic joints follow; otherwise each joint counts as driven.
    followed: Option<Robot>,
    q: RobotQ,
    poses: Vec<Pose>,
}

/// The links and joints of two robots with the same moving joints by name; `None` if a source of poses fails.
pub(super) fn matched_robots(robots: [&Robot; 2]) -> Option<MatchedRobots<'_>> {
    MatchedRobots::new(robots, &mut PosesOfOther::new(robots[0], robots[1])).ok()
}

/// The link of the same name, if another joint of the robot moves it in the other description: names of joints are exchanged, and
/// those of links are not.
fn exchanged(link: LinkIndex, robot: &Robot, other: &Robot) -> Option<LinkIndex> {
    let there = other.find_link(&robot.link(link).name)?;
    let [own, moving] = [robot.joint(robot.parent_joint(link)?), other.joint(other.parent_joint(there)?)];
    let is_of_both = robot.find_joint(&moving.name).is_some() && other.find_joint(&own.name).is_some();
    (moving.kind.is_movable() && moving.name != own.name && is_of_both).then_some(there)
}

/// Where a link of the robot is found.
enum LinkCorrespondence {
    /// At this link of the other, which moves as it does.
    Other(usize),
    /// The other lacks it: it moves with this link of the robot.
    Behind(usize, Pose),
    /// The link is the root.
    Root,
}

impl PosesOfOther {
    /// Each joint counts as driven.
    pub(super) fn new(robot: &Robot, other: &Robot) -> Self {
        let place = |link| {
            let joint = robot.parent_joint(link).map(|joint| robot.joint(joint));
            let there = joint
                .filter(|joint| joint.kind.is_movable())
                .and_then(|_| exchanged(link, robot, other))
                .or_else(|| same_link(link, robot, other));
            match (there, joint) {
                (Some(there), _) => LinkCorrespondence::Other(there.get()),
                (None, Some(joint)) => {
                    LinkCorrespondence::Behind(joint.parent.get(), Pose::from(joint.parent_from_joint))
                }
                (None, None) => LinkCorrespondence::Root,
            }
        };
        let coordinate = |name: &str| robot.coordinate(robot.find_joint(name)?);
        Self {
            tree: UrdfTree::new(other),
            links: robot.link_indices().map(place).collect(),
            there_from_links: vec![Pose::identity(); robot.links().len()],
            coordinates: other.movable_joint_names().filter_map(coordinate).collect(),
            followed: None,
            q: RobotQ::zeros(other.dof()),
            poses: vec![Pose::identity(); other.links().len()],
        }
    }

    /// The links of the robot that the other description lacks: nothing of them is compared.
    pub(super) fn lacking<'a>(&'a self, robot: &'a Robot) -> impl Iterator<Item = LinkIndex> + 'a {
        let is_lacking = |link: &LinkIndex| matches!(self.links[link.get()], LinkCorrespondence::Behind(..));
        robot.link_indices().filter(is_lacking)
    }

    /// A link between joints that is but a name in one of the two descriptions, without inertia and shape, has nothing that its
    /// frame could misplace: there it may lie anywhere, if the joints move all links alike. The pose at zero is taken; base,
    /// tip and the ends of branches keep their frames.
    pub(super) fn with_free_frames(
        mut self,
        description: &RobotDescription,
        other: &Robot,
    ) -> Result<Self, LinkPosesError> {
        let robot = &description.robot;
        let zero = RobotQ::zeros(robot.dof());
        let [mut here, mut there] = [robot, robot].map(|robot| vec![Pose::identity(); robot.links().len()]);
        UrdfTree::new(robot).root_from_links_into(&zero, &mut here)?;
        self.root_from_links_into(&zero, &mut there)?;
        let is_name =
            |link: &Link| link.inertia.is_none() && link.visuals.is_empty() && link.collisions.is_empty();
        for index in robot.link_indices() {
            let LinkCorrespondence::Other(found) = self.links[index.get()] else { continue };
            let is_moved = robot.parent_joint(index).is_some_and(|at| robot.joint(at).kind.is_movable());
            let is_between = robot.joints().iter().any(|joint| joint.parent == index)
                && index != description.base
                && index != description.tip;
            let at = index.get();
            let is_elsewhere = !PoseError::between(&here[at], &there[at]).is_within(&description.tolerance);
            let is_name = is_name(&other.links()[found]) || is_name(robot.link(index));
            if is_moved && is_between && is_elsewhere && is_name {
                self.there_from_links[at] = there[at].inverse() * here[at];
            }
        }
        // Behind an origin that is off, links move otherwise: taken at their poses at zero they would hide its displacement
        // there, and show it twice elsewhere.
        if self.has_free_frames() && !self.moves_alike(description)? {
            self.there_from_links.fill(Pose::identity());
        }
        Ok(self)
    }

    /// Whether the links have the poses of the robot's own description.
    fn moves_alike(&mut self, description: &RobotDescription) -> Result<bool, LinkPosesError> {
        let robot = &description.robot;
        let [mut here, mut there] = [robot, robot].map(|robot| vec![Pose::identity(); robot.links().len()]);
        let tree = UrdfTree::new(robot);
        for q in sample_configurations(robot, 0, POSITIONS) {
            tree.root_from_links_into(&q, &mut here)?;
            self.root_from_links_into(&q, &mut there)?;
            let is_same = |(here, there)| PoseError::between(here, there).is_within(&description.tolerance);
            if !here.iter().zip(&there).all(is_same) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether a link is where the other description does not have its frame.
    pub(super) fn has_free_frames(&self) -> bool {
        self.there_from_links.iter().any(|pose| *pose != Pose::identity())
    }

    /// Mimic joints of the other follow as the other says.
    pub(super) fn with_mimics(robot: &Robot, other: &Robot) -> Self {
        Self { followed: Some(other.clone()), ..Self::new(robot, other) }
    }
}

impl LinkPoses for PosesOfOther {
    fn root_from_links_into(
        &mut self,
        q: &RobotQ,
        root_from_links: &mut [Pose],
    ) -> Result<(), LinkPosesError> {
        for (at, &coordinate) in self.coordinates.iter().enumerate() {
            self.q[at] = q[coordinate];
        }
        if let Some(other) = &self.followed {
            other.apply_mimic(&mut self.q);
        }
        self.tree.root_from_links_into(&self.q, &mut self.poses)?;
        for (link, place) in self.links.iter().enumerate() {
            root_from_links[link] = match *place {
                LinkCorrespondence::Other(there) => self.poses[there] * self.there_from_links[link],
                // A parent comes before its children.
                LinkCorrespondence::Behind(parent, parent_from_link) => {
                    root_from_links[parent] * parent_from_link
                }
                LinkCorrespondence::Root => Pose::identity(),
            };
        }
        Ok(())
    }
}
