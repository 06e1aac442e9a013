//! The same scenario twice, and continued from a snapshot in another source, is the same run, bit by bit.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::path::Path;

use congruent_twin::{
    Run, RunSetup,
    motion::ServoResult,
    recorder::NoRecorder,
    scenario::Override,
    source::{JointSample, JointStateSource, SimulationSource, SourceError},
};
use nalgebra::Isometry3;

/// A source that goes on in a fresh one, from a snapshot, at a step in the middle; and that first goes a way off.
struct Restored<'a> {
    setup: &'a RunSetup,
    source: SimulationSource<'a>,
    at_step: u64,
}

impl JointStateSource for Restored<'_> {
    fn joints(&self) -> JointSample<'_> {
        self.source.joints()
    }

    fn step_count(&self) -> u64 {
        self.source.step_count()
    }

    fn root_from_links_into(&self, root_from_links: &mut [Isometry3<f64>]) -> bool {
        self.source.root_from_links_into(root_from_links)
    }

    fn advance(&mut self, time_s: f64) -> Result<(), SourceError> {
        if self.step_count() == self.at_step {
            let snapshot = self.source.snapshot();
            let mut other = SimulationSource::new(self.setup).unwrap();
            // What the other has done before is forgotten.
            for step in 1..=20 {
                other.advance(self.setup.clock.time_s(step))?;
            }
            other.restore(&snapshot);
            self.source = other;
        }
        self.source.advance(time_s)
    }

    fn finish(&mut self) -> Result<Vec<ServoResult>, SourceError> {
        self.source.finish()
    }
}

fn hash(setup: &RunSetup, source: Box<dyn JointStateSource + '_>) -> String {
    let run = Run::with_source(setup, source).unwrap();
    let (outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
    result.unwrap();
    assert!(outcome.steps > 500, "{} steps", outcome.steps);
    outcome.trajectory_sha256
}

fn setup(name: &str, set: &[&str]) -> RunSetup {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    let set: Vec<Override> = set.iter().map(|change| change.parse().unwrap()).collect();
    RunSetup::load(&path, &set).unwrap()
}

/// The hash of the run, which is the same a second time and from a snapshot.
#[track_caller]
fn same_after_a_snapshot(setup: &RunSetup, at_step: u64) -> String {
    let source = || SimulationSource::new(setup).unwrap();
    let through = hash(setup, Box::new(source()));
    assert_eq!(through, hash(setup, Box::new(source())), "twice");
    let restored = Restored { setup, source: source(), at_step };
    assert_eq!(through, hash(setup, Box::new(restored)), "from a snapshot");
    through
}

#[test]
fn planned_moves_go_on_from_a_snapshot() {
    same_after_a_snapshot(&setup("ur5e_pick.toml", &[]), 1234);
}

#[test]
fn servos_go_on_from_a_snapshot() {
    same_after_a_snapshot(&setup("rrr_arm_servo.toml", &[]), 2345);
}

#[test]
fn contacts_go_on_from_a_snapshot() {
    let driven =
        ["controller.kind=gravity_compensation", "controller.stiffness=2000", "controller.damping=120"];
    let with = |place: &str| {
        let set: Vec<&str> = driven.into_iter().chain([place]).collect();
        same_after_a_snapshot(&setup("ur5e_into_table.toml", &set), 1700)
    };
    // A table so high that the arm lies on it before that step; far below, nothing is touched.
    let (high, far) = ("obstacle.1.xyz_m=[0.9, 0.04, 0.2]", "obstacle.1.xyz_m=[0.9, 0.04, -5.0]");
    assert_ne!(with(high), with(far));
}
