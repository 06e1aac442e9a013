//! Whether two descriptions have the same moving joints by name, and the link up to which they have.

use congruent_description::{ChainEnd, JointIndex, LinkIndex, Robot, RobotDescription};

/// The first moving joint that one of the two descriptions lacks, or that turns in one and slides in the other.
pub fn other_joint(robot: &Robot, other: &Robot) -> Option<String> {
    let moving_joints = [robot, other].map(|robot| robot.movable_joints().len());
    let counts = match moving_joints {
        [own, there] if own == there => String::new(),
        [own, there] => format!(" ({own} joints move in this one, {there} in the other)"),
    };
    let missing = |joint: &str, (of, lacks): (&str, &Robot)| match lacks.find_joint(joint) {
        Some(_) => format!("joint \"{joint}\" does not move in {of}{counts}"),
        None => format!("{of} has no joint \"{joint}\"{counts}"),
    };
    for &index in robot.movable_joints() {
        let joint = robot.joint(index);
        let Some(there) = moving(other, &joint.name) else {
            return Some(missing(&joint.name, ("the other description", other)));
        };
        if other.joint(there).kind.is_angular() != joint.kind.is_angular() {
            return Some(format!(
                "joint \"{}\" turns in one description and slides in the other",
                joint.name
            ));
        }
    }
    // Joints of the other that are lacking here, after those of this robot, so that the first of the chain is
    // named.
    let mut others = other.movable_joint_names();
    others
        .find(|name| moving(robot, name).is_none())
        .map(|name| missing(name, ("this description, unlike the other,", robot)))
}

/// The last link of the chain that both descriptions have and up to which they have the same moving joints; `None` if no joint
/// moves it, or if the caller has named it already.
pub fn common_tip(description: &RobotDescription, other: &Robot) -> Option<String> {
    let robot = &description.robot;
    let mut chain = robot.chain(description.base, description.tip)?;
    let is_common = |&index: &JointIndex| {
        let joint = robot.joint(index);
        let there = || moving(other, &joint.name).map(|there| other.joint(there).kind.is_angular());
        !joint.kind.is_movable() || there() == Some(joint.kind.is_angular())
    };
    chain.truncate(chain.iter().take_while(|joint| is_common(joint)).count());
    let first_moving = chain.iter().position(|&joint| robot.joint(joint).kind.is_movable())?;
    let links = chain[first_moving..].iter().rev().map(|&joint| robot.joint(joint).child);
    let is_named =
        |link: &LinkIndex| *link == description.tip && description.chain_ends.tip != ChainEnd::Chosen;
    links
        .filter(|link| !is_named(link))
        .map(|link| robot.link(link).name.clone())
        .find(|name| other.find_link(name).is_some())
}

fn moving(robot: &Robot, name: &str) -> Option<JointIndex> {
    robot.find_joint(name).filter(|&joint| robot.joint(joint).kind.is_movable())
}
