//! A description of a part of a robot, and the requested configurations in its joints.

use std::{collections::BTreeSet, sync::Arc};

use congruent_agreement::compare::CheckOptions;
use congruent_description::{Places, Robot, RobotDescription, RobotQList};

/// The description of a part of the robot, or of the robot in other variables. Its table and declared inertias are of the whole
/// robot and are left out.
pub(super) fn part(whole: &RobotDescription, robot: Robot) -> RobotDescription {
    let link = |of| robot.find_link(&whole.robot.link(of).name).unwrap_or(robot.root());
    let acceleration = |name: &str| {
        let coordinate = whole.robot.coordinate(whole.robot.find_joint(name)?)?;
        whole.accelerations[coordinate]
    };
    RobotDescription {
        base: link(whole.base),
        tip: link(whole.tip),
        accelerations: robot.movable_joint_names().map(acceleration).collect(),
        dh: None,
        dynamics: None,
        disabled_collisions: BTreeSet::new(),
        places: Places { robot_file: None, inertials: None, ..whole.places.clone() },
        robot,
        ..whole.clone()
    }
}

/// The requested configurations in the joints of the part.
pub(super) fn kept_joints(
    whole: &RobotDescription,
    part: &RobotDescription,
    options: &CheckOptions,
) -> Arc<RobotQList> {
    let mut configurations = RobotQList::new(part.robot.dof());
    let coordinate = |name: &str| whole.robot.coordinate(whole.robot.find_joint(name)?);
    for q in options.configurations.iter() {
        let kept = part.robot.movable_joint_names().filter_map(coordinate);
        configurations.push(&kept.map(|at| q[at]).collect::<Vec<f64>>());
    }
    configurations.into()
}
