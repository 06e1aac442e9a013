//! What people wait for, from end to end: a check whose dynamics disagree, the manipulability of many configurations, a run with
//! everything that it writes.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::{
    analysis::manipulability::manipulability,
    check,
    description::RobotQ,
    page::PageFormat,
    prelude::{CheckOptions, Options, RerunFormat, RobotDescription, RunSetup, execute, load_robot},
};
use divan::{Bencher, counter::ItemsCount};
use tempfile::TempDir;

fn main() {
    divan::main();
}

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The UR5e with the masses of its `[[inertial]]` entries rounded to 0.1 kg.
fn with_rounded_masses() -> RobotDescription {
    let (from, to) = (workspace().join("robots/ur5e"), TempDir::new().expect("a folder"));
    fs::copy(from.join("ur5e.urdf"), to.path().join("ur5e.urdf")).expect("the URDF is part of the project");
    let text = fs::read_to_string(from.join("robot.toml")).expect("the robot file is part of the project");
    let rounded = |line: &str| match line.strip_prefix("mass_kg = ").map(str::parse::<f64>) {
        Some(Ok(mass_kg)) => format!("mass_kg = {mass_kg:.1}\n"),
        _ => format!("{line}\n"),
    };
    let path = to.path().join("robot.toml");
    fs::write(&path, text.lines().map(rounded).collect::<String>()).expect("the folder is ours");
    load_robot(&path).expect("only masses were changed")
}

/// `congruent check` if masses disagree: the cause in both files, and the bound of the torques.
#[divan::bench(sample_count = 10)]
fn check_with_rounded_masses(bencher: Bencher<'_, '_>) {
    let description = with_rounded_masses();
    bencher.bench_local(|| {
        let robot = check(&description, &CheckOptions::default()).expect("both have the same chain");
        assert!(robot.dynamics.is_some_and(|report| report.certificates.is_some()));
    });
}

/// One item is one configuration, as JSON.
#[divan::bench]
fn manipulability_of_many(bencher: Bencher<'_, '_>) {
    const COUNT: u32 = 1_000;
    let description = load_robot(&workspace().join("robots/ur5e")).expect("the robot is part of the project");
    let dof = description.robot.dof();
    let at = |index: u32| -> RobotQ { vec![0.001 * f64::from(index); dof].into() };
    bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
        let report = manipulability(&description, (0..COUNT).map(at), None).expect("it has an arm");
        serde_json::to_string(&report).expect("each configuration has an answer")
    });
}

/// `congruent run` of 60 s with recording and page: 60 s divided by the time is how many times faster than real time it runs.
#[divan::bench(sample_count = 5)]
fn run_of_a_minute(bencher: Bencher<'_, '_>) {
    let longer = ["simulation.duration_s=60".parse().expect("a key and a value")];
    let setup = RunSetup::load(&workspace().join("scenarios/ur5e_pick.toml"), &longer);
    let setup = setup.expect("the scenario is part of the project");
    let out = TempDir::new().expect("a folder");
    bencher.bench_local(|| {
        let options = Options {
            out: out.path().to_owned(),
            recordings: vec![&RerunFormat, &PageFormat],
            interrupt: None,
        };
        execute(&setup, &options, |_| ()).expect("the scenario runs")
    });
}
