//! The run loop takes joint states from any source: here positions that a program computes, as a log or a live
//! robot would give them. `cargo run --example joint_states_of_my_own`

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{error::Error, path::Path};

use congruent::{
    description::RobotQ,
    nalgebra::Isometry3,
    prelude::*,
    twin::source::{JointStateSource, SourceError},
};
use congruent_monitors::{JointSample, JointStateView, NoRecorder};
use congruent_scenario::{AgreementCheck, Check, SimulationSettings};

/// All joints swing together.
struct Swing {
    q: RobotQ,
    steps: u64,
}

impl JointStateSource for Swing {
    fn joints(&self) -> JointSample<'_> {
        let state = JointStateView { q: &self.q, qd: &[], effort: &[] };
        JointSample { truth: state, measured: state, setpoint: None }
    }

    fn step_count(&self) -> u64 {
        self.steps
    }

    // The source knows no poses, so the links are placed by the URDF.
    fn root_from_links_into(&self, _: &mut [Isometry3<f64>]) -> bool {
        false
    }

    fn advance(&mut self, time_s: f64) -> Result<(), SourceError> {
        self.q.fill(0.5 * time_s.sin());
        self.steps += 1;
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/panda"));
    let description = load_robot(robot)?;
    let source = Swing { q: RobotQ::zeros(description.robot.dof()), steps: 0 };
    let scenario = Scenario {
        name: "swing".to_owned(),
        simulation: SimulationSettings { duration_s: Some(5.0), ..SimulationSettings::default() },
        check: vec![Check::Agreement(AgreementCheck::default())],
        ..Scenario::default()
    };
    let setup = RunSetup::new(scenario, description)?;
    let mut run = Run::with_source(&setup, Box::new(source))?;
    let (outcome, ended) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
    ended?;
    for measure in outcome.checks.iter().flat_map(|check| &check.measures) {
        let worst = measure.worst.as_ref().map_or(0.0, |moment| moment.value);
        println!("{} steps: {} {worst:.1e} {}", outcome.steps, measure.quantity, measure.unit);
    }
    Ok(())
}
