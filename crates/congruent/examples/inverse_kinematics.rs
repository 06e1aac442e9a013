//! Inverse kinematics and back: which joint positions bring the tool to a pose, and is it there?
//! `cargo run --example inverse_kinematics`

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{error::Error, path::Path};

use congruent::{
    description::ArmQ,
    kinematics::{IkOptions, IkSolver, IkTarget, TargetPart},
    prelude::*,
};

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e"));
    let description = load_robot(robot)?;
    let arm = Arm::from_description(&description)?;
    let there = ArmQ::from([0.3, -1.2, 1.4, -0.8, -1.5, 0.2]);
    let base_from_tcp = arm.clone().base_from_tcp(&there)?;

    let start = ArmQ::zeros(arm.joints().len());
    let target = IkTarget { base_from_tcp, part: TargetPart::Pose };
    let mut solver = IkSolver::new(arm);
    let result = solver.solve(&target, &start, &IkOptions::default(), || true)?;
    println!("converged: {} after {} steps", result.converged, result.iterations);
    println!("joint positions: {:.6?} rad", &result.q[..]);
    println!("residual: {:.1e} m, {:.1e} rad", result.residual_position_m, result.residual_orientation_rad);
    Ok(())
}
