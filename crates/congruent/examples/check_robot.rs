//! Are table, URDF and physics of a robot the same robot? `cargo run --example check_robot -- robots/ur5e`

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{env, error::Error, path::PathBuf};

use congruent::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    let robot = env::args().nth(1).map_or_else(default_robot, PathBuf::from);
    let description = load_robot(&robot)?;
    let report = check(&description, &CheckOptions::default())?;
    println!("{}: {}", report.geometry.robot, report.geometry.verdict);
    for comparison in &report.geometry.comparisons {
        let worst = comparison.worst.error.position_m;
        println!("  {}: {}, worst {worst:.1e} m", comparison.title, comparison.verdict);
    }
    for cause in &report.geometry.diagnosis {
        println!("  {}", cause.fault.suggestion);
    }
    Ok(())
}

fn default_robot() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e"))
}
