//! Errors against closed forms, tables that are changed, another program, and draws.

mod certificate;
mod closed_form;
mod digits;
mod independent;

use congruent_description::{
    ArmQ, DeclaredTolerances, FrameTolerances, ParameterTolerances, RobotDescription, RobotQ, load_robot,
};
use congruent_kinematics::Arm;

use crate::study::random_configurations;

/// A robot of the project.
fn robot(path: &str) -> RobotDescription {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    load_robot(&std::path::Path::new(root).join(path)).expect("a robot of the project")
}

/// 0.05 mm and 0.02 deg of everything that the robot has.
fn typical(description: &RobotDescription) -> DeclaredTolerances {
    let (length, angle) = (Some(5e-5), Some(0.02_f64.to_radians()));
    let frame = FrameTolerances { position_m: length, orientation_rad: angle };
    let zeros = ParameterTolerances { zero_rad: angle, zero_m: length, ..ParameterTolerances::default() };
    let general = if description.dh.is_some() {
        ParameterTolerances { a_m: length, d_m: length, alpha_rad: angle, theta_rad: angle, ..zeros }
    } else {
        ParameterTolerances { xyz_m: length, rpy_rad: angle, ..zeros }
    };
    DeclaredTolerances { general, base: frame, tcp: frame, ..DeclaredTolerances::default() }
}

/// The same of the rows of a table alone.
fn of_rows() -> DeclaredTolerances {
    let typical = typical(&robot("robots/ur5e"));
    let general = ParameterTolerances { zero_m: None, zero_rad: None, ..typical.general };
    DeclaredTolerances { general, ..DeclaredTolerances::default() }
}

/// Random configurations.
fn drawn(description: &RobotDescription, count: usize) -> Vec<RobotQ> {
    let arm = Arm::from_description(description).expect("an arm");
    random_configurations(description, &arm, count, 7).iter().collect()
}

/// A configuration of the arm alone, in the robot's vector.
fn robot_q(description: &RobotDescription, q: &[f64]) -> RobotQ {
    let arm = Arm::from_description(description).expect("an arm");
    let mut q_robot = RobotQ::zeros(description.robot.dof());
    arm.write_to_robot(&q.iter().copied().collect::<ArmQ>(), &mut q_robot);
    q_robot
}
