//! The run loop takes joint states from any source: here positions that a program computes, as a log or a live
//! robot would give them. `cargo run --example joint_states_of_my_own`

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{error::Error, path::Path};

use congruent::{
    description::RobotQ,
    prelude::*,
    twin::source::{Advance, JointStateSource, SourceError},
};
use congruent_monitors::{JointSample, JointStateView, NoRecorder};
use congruent_scenario::{AgreementCheck, Check};

/// All joints swing together for 5 s.
struct Swing {
    q: RobotQ,
    time_s: f64,
}

impl JointStateSource for Swing {
    fn joints(&self) -> JointSample<'_> {
        JointSample::measured(JointStateView { q: &self.q, qd: &[], effort: &[] })
    }

    fn advance(&mut self, wanted_s: f64) -> Result<Advance, SourceError> {
        self.time_s = wanted_s;
        self.q.fill(0.5 * wanted_s.sin());
        Ok(Advance::At(wanted_s))
    }

    fn is_last(&self) -> bool {
        self.time_s >= 5.0
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/panda"));
    let description = load_robot(robot)?;
    let source = Swing { q: RobotQ::zeros(description.robot.dof()), time_s: 0.0 };
    let scenario = Scenario {
        name: "swing".to_owned(),
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
