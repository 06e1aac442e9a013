//! Names of links of another description, so that links of one name are the same link.

use std::collections::BTreeMap;

use congruent_description::{LinkIndex, Robot, RobotDescription};
use congruent_kinematics::{PoseError, ScrewTree};

/// What links and joints that are fixed to a fitted base have behind their names.
pub(crate) const OF_FITTED_BASE: &str = " (fixed to the fitted base)";

/// The names that links of the other description have in this one: of the root, of those that the joints carry, and of the tip if
/// both are the same frame.
pub fn link_names(own: &RobotDescription, other: &Robot, tip: &str) -> BTreeMap<LinkIndex, String> {
    let robot = &own.robot;
    let trees = [robot, other].map(ScrewTree::new);
    let mut names = BTreeMap::from([(other.root(), root_name(robot, other, &trees[0]))]);
    for joint in other.joints().iter().filter(|joint| joint.kind.is_movable()) {
        let Some(here) = robot.find_joint(&joint.name) else { continue };
        names.insert(joint.child, robot.link(robot.joint(here).child).name.clone());
    }
    let own_tip = &robot.link(own.tip).name;
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

/// The name of the other root here: its own if a link at the root is called so, as behind the world of an MJCF.
fn root_name(robot: &Robot, other: &Robot, screws: &ScrewTree) -> String {
    let (root, name) = (robot.root(), &other.link(other.root()).name);
    let is_root = |link: &LinkIndex| {
        let off = PoseError::between(screws.home(root), screws.home(*link));
        robot.body(*link) == root && off == PoseError::default()
    };
    robot.find_link(name).filter(is_root).map_or_else(|| robot.link(root).name.clone(), |_| name.clone())
}

/// The robot with other names of the links that are fixed to its root, and of the joints that fix them, so that no link of another
/// description is one of them.
#[must_use]
pub fn with_other_still_links(robot: &Robot) -> Robot {
    let is_still = |link: &LinkIndex| robot.body(*link) == robot.root() && *link != robot.root();
    let name = |name: &str| format!("{name}{OF_FITTED_BASE}");
    let links = robot.link_indices().filter(is_still);
    let names = links.map(|link| (link, name(&robot.link(link).name))).collect();
    let renamed = robot.with_link_names(&names);
    renamed.with_joints(|joint| {
        if names.contains_key(&joint.child) {
            joint.name = name(&joint.name);
        }
    })
}

/// The link of the other description that is the same as this one; the two have the same moving joints by name. Links behind moving
/// joints are matched by the joint's name: exporters rename links more often than joints.
pub fn same_link(link: LinkIndex, robot: &Robot, other: &Robot) -> Option<LinkIndex> {
    let carrying = robot.parent_joint(link).map(|joint| robot.joint(joint));
    let Some(carrying) = carrying.filter(|joint| joint.kind.is_movable()) else {
        return same_fixed_link(link, robot, other);
    };
    let there = other.joint(other.find_joint(&carrying.name)?);
    // A frame that was chosen for the joint's link agrees with any: a tip of this name behind it is where the description says.
    let is_chosen = !there.rounding.frame.is_empty();
    let named = other.find_link(&robot.link(link).name).filter(|_| is_chosen);
    Some(named.filter(|named| other.body(*named) == there.child).unwrap_or(there.child))
}

/// The link of the other description that is a link of the robot behind a fixed joint: the one of its name, or at the end of a
/// branch the one that the joint of the same name carries, if the robot has no link of that name.
fn same_fixed_link(link: LinkIndex, robot: &Robot, other: &Robot) -> Option<LinkIndex> {
    other.find_link(&robot.link(link).name).or_else(|| {
        let carrying = robot.joint(robot.parent_joint(link)?);
        let there = other.joint(other.find_joint(&carrying.name)?);
        let is_end = robot.joints().iter().all(|joint| joint.parent != link);
        let is_known = robot.find_link(&other.link(there.child).name).is_some();
        (is_end && !there.kind.is_movable() && !is_known).then_some(there.child)
    })
}
