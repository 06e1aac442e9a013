//! The same scenario twice is the same run, bit by bit.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::path::Path;

use congruent_input::Override;
use congruent_monitors::NoRecorder;
use congruent_twin::{Run, RunSetup};

fn hash(setup: &RunSetup) -> String {
    let mut run = Run::new(setup).unwrap();
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

/// The hash of the run, which is the same a second time.
#[track_caller]
fn same_twice(setup: &RunSetup) -> String {
    let first = hash(setup);
    assert_eq!(first, hash(setup));
    first
}

#[test]
fn planned_moves_are_the_same_twice() {
    same_twice(&setup("ur5e_pick.toml", &[]));
}

#[test]
fn servos_are_the_same_twice() {
    same_twice(&setup("rrr_arm_servo.toml", &[]));
}

#[test]
fn contacts_are_the_same_twice() {
    let driven =
        ["controller.kind=gravity_compensation", "controller.stiffness=2000", "controller.damping=120"];
    let with = |place: &str| {
        let set: Vec<&str> = driven.into_iter().chain([place]).collect();
        same_twice(&setup("ur5e_into_table.toml", &set))
    };
    // A table so high that the arm lies on it; far below, nothing is touched.
    let (high, far) = ("obstacle.1.xyz_m=[0.9, 0.04, 0.2]", "obstacle.1.xyz_m=[0.9, 0.04, -5.0]");
    assert_ne!(with(high), with(far));
}
