//! A scenario made in code and run with several stiffnesses: whatever the gains, model and twin agree.
//! `cargo run --example scenario_in_code`

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{collections::BTreeMap, error::Error, path::Path};

use congruent::prelude::*;
use congruent_monitors::NoRecorder;
use congruent_scenario::{
    AgreementCheck, Check, ControllerKind, ControllerSettings, JointMotion, MotionSettings,
    SimulationSettings,
};

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e"));
    let description = load_robot(robot)?;
    for stiffness in [500.0, 2000.0, 8000.0] {
        let setup = RunSetup::new(lift(stiffness), description.clone())?;
        let mut run = Run::new(&setup)?;
        let (outcome, ended) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
        ended?;
        for measure in outcome.checks.iter().flat_map(|check| &check.measures) {
            let worst = measure.worst.as_ref().map_or(0.0, |moment| moment.value);
            println!("{stiffness} N m/rad: {} {worst:.1e} {}", measure.quantity, measure.unit);
        }
    }
    Ok(())
}

/// The shoulder lifts the arm against gravity in one second.
fn lift(stiffness: f64) -> Scenario {
    let lift = JointMotion {
        move_joints_deg: BTreeMap::from([("shoulder_lift_joint".to_owned(), -60.0)]),
        duration_s: Some(1.0),
        ..JointMotion::default()
    };
    Scenario {
        name: "lift".to_owned(),
        simulation: SimulationSettings { duration_s: Some(1.5), ..SimulationSettings::default() },
        controller: ControllerSettings {
            kind: ControllerKind::Pd,
            stiffness: stiffness.into(),
            damping: (stiffness / 10.0).into(),
            ..ControllerSettings::default()
        },
        motion: vec![MotionSettings::Joints(lift)],
        check: vec![Check::Agreement(AgreementCheck::default())],
        ..Scenario::default()
    }
}
