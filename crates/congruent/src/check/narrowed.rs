//! `check --against --tip`: two descriptions are compared from the root to the tip, whatever else either of them moves.

use std::collections::BTreeSet;

use congruent_agreement::compare::CheckOptions;
use congruent_description::{ChainEnd, Places, Robot, RobotDescription, RobotQList};

/// Two descriptions without the joints that do not move the tip, and the links beyond these joints.
pub(super) struct NarrowedPair {
    pub(super) description: RobotDescription,
    pub(super) other: RobotDescription,
    /// The options with the requested configurations in the joints that are compared.
    pub(super) options: CheckOptions,
    /// The joints of either that are left out.
    pub(super) left_out: Vec<String>,
}

impl NarrowedPair {
    /// `None` if the caller did not name the tip, or if all joints move it.
    pub(super) fn new(
        description: &RobotDescription,
        other: &RobotDescription,
        options: &CheckOptions,
    ) -> Option<Self> {
        let robot = &description.robot;
        if description.chain_ends.tip != ChainEnd::Given {
            return None;
        }
        let names = robot.joints_that_move(description.tip);
        let mut left_out: Vec<String> = Vec::new();
        for name in robot.movable_joint_names().chain(other.robot.movable_joint_names()) {
            if !names.contains(name) && !left_out.iter().any(|known| known == name) {
                left_out.push(name.to_owned());
            }
        }
        let coordinates: Vec<usize> = robot
            .movable_joint_names()
            .enumerate()
            .filter(|(_, name)| names.contains(name))
            .map(|(coordinate, _)| coordinate)
            .collect();
        let mut configurations = RobotQList::new(coordinates.len());
        for q in options.configurations.iter() {
            configurations.push(&coordinates.iter().map(|&coordinate| q[coordinate]).collect::<Vec<f64>>());
        }
        let options = CheckOptions { configurations: configurations.into(), ..options.clone() };
        let tip = &robot.link(description.tip).name;
        let [description, other] = [description, other].map(|of| part(of, &names, tip));
        (!left_out.is_empty()).then_some(Self { description, other, options, left_out })
    }
}

/// The part of a description that these joints move. Its table and declared inertias are of the whole robot and are left out.
fn part(whole: &RobotDescription, names: &BTreeSet<&str>, tip: &str) -> RobotDescription {
    let robot = whole.robot.moved_by(names);
    let is_kept = |robot: &Robot, name: &str| robot.find_joint(name).is_some();
    let accelerations = whole.robot.movable_joint_names().zip(&whole.accelerations);
    let accelerations =
        accelerations.filter(|(name, _)| is_kept(&robot, name)).map(|(_, acceleration)| *acceleration);
    RobotDescription {
        base: robot.find_link(&whole.robot.link(whole.base).name).unwrap_or(robot.root()),
        tip: robot.find_link(tip).unwrap_or(robot.root()),
        accelerations: accelerations.collect(),
        dh: None,
        dynamics: None,
        disabled_collisions: BTreeSet::new(),
        places: Places { robot_file: None, inertials: None, urdf: whole.places.urdf.clone() },
        robot,
        ..whole.clone()
    }
}
