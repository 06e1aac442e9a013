//! Names of links of another description, so that links of one name are the same link.

use std::collections::BTreeMap;

use congruent_description::{LinkIndex, Robot, RobotDescription};
use congruent_kinematics::{PoseError, ScrewTree};

/// The names that links of the other description have in this one: of the root, of those that the joints carry, and of the tip if
/// both are the same frame.
pub fn link_names(own: &RobotDescription, other: &Robot, tip: &str) -> BTreeMap<LinkIndex, String> {
    let robot = &own.robot;
    let mut names = BTreeMap::from([(other.root(), robot.link(robot.root()).name.clone())]);
    for joint in other.joints().iter().filter(|joint| joint.kind.is_movable()) {
        let Some(here) = robot.find_joint(&joint.name) else { continue };
        names.insert(joint.child, robot.link(robot.joint(here).child).name.clone());
    }
    let own_tip = &robot.link(own.tip).name;
    let trees = [robot, other].map(ScrewTree::new);
    let there = other.find_link(tip).filter(|there| !names.contains_key(there));
    if let Some(there) = there.filter(|_| other.find_link(own_tip).is_none()) {
        let off = PoseError::between(trees[0].home(own.tip), trees[1].home(there));
        let is_same_body = !names.values().any(|name| name == own_tip);
        if is_same_body && off.is_within(&own.tolerance) {
            names.insert(there, own_tip.clone());
        }
    }
    names
}

/// The robot with other names of the links that are fixed to its root, so that no link of another description is one of them.
#[must_use]
pub fn with_other_still_links(robot: &Robot) -> Robot {
    let is_still = |link: &LinkIndex| robot.body(*link) == robot.root() && *link != robot.root();
    let name = |link: LinkIndex| format!("{} (fixed to the fitted base)", robot.link(link).name);
    robot.with_link_names(&robot.link_indices().filter(is_still).map(|link| (link, name(link))).collect())
}
