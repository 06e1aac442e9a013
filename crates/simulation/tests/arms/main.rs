//! The gates that need no golden file, on the UR5e and the Panda of this project. Numbers (a05 and so on) are those of
//! the table of gates.

#![allow(clippy::print_stdout, reason = "the worst values, for those who run with --nocapture")]

mod rollouts;
mod servos;
mod states;
#[path = "../support/mod.rs"]
mod support;

use std::path::Path;

use congruent_description::{Joint, Robot, RobotQ, load_robot};

pub(crate) const ARMS: [&str; 2] = ["ur5e", "panda"];

/// A robot of the project with each joint changed.
pub(crate) fn arm(name: &str, change: impl FnMut(&mut Joint)) -> Robot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    let description = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}"));
    description.robot.with_joints(change)
}

/// Without limits, damping and friction.
pub(crate) fn free(name: &str) -> Robot {
    arm(name, |joint| (joint.damping, joint.friction, joint.limit) = (0.0, 0.0, None))
}

/// 0.3 + 0.1 i at joints that turn, away from every symmetry; 0.02 m at those that slide.
pub(crate) fn q0(robot: &Robot) -> RobotQ {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    let at = |(row, joint): (usize, &Joint)| {
        if joint.kind.is_angular() {
            0.3 + 0.1 * f64::from(u8::try_from(row).expect("few joints"))
        } else {
            0.02
        }
    };
    joints.map(at).collect()
}
