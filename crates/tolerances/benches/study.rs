//! The time of a study of a UR5e with 24 tolerances, and how it grows with draws and configurations.

use std::path::Path;

use congruent_description::{
    DeclaredTolerances, ParameterTolerances, RequestedTolerance, RobotDescription, load_robot,
};
use congruent_tolerances::{StudyOptions, ToleranceSource, ToleratedChain, declared, tolerance_study};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

fn ur5e() -> (RobotDescription, ToleratedChain) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e");
    let description = load_robot(&path).expect("a robot of the project");
    let (length, angle) = (Some(5e-5), Some(3.5e-4));
    let general = ParameterTolerances {
        a_m: length,
        d_m: length,
        alpha_rad: angle,
        theta_rad: angle,
        ..ParameterTolerances::default()
    };
    let tolerances = DeclaredTolerances { general, ..DeclaredTolerances::default() };
    let tolerated = declared(&description, &tolerances).expect("the robot has a table");
    (description, tolerated)
}

fn options(samples: usize, random: usize) -> StudyOptions {
    StudyOptions {
        source: ToleranceSource::Options,
        given: None,
        random,
        samples,
        seed: 0,
        required: RequestedTolerance::default(),
    }
}

#[divan::bench(args = [1_000, 100_000, 1_000_000])]
fn draws(bencher: Bencher, samples: usize) {
    let (description, tolerated) = ur5e();
    bencher.bench(|| tolerance_study(black_box(&description), &tolerated, &options(samples, 100)));
}

#[divan::bench(args = [100, 500, 2_000])]
fn configurations(bencher: Bencher, random: usize) {
    let (description, tolerated) = ur5e();
    bencher.bench(|| tolerance_study(black_box(&description), &tolerated, &options(1_000, random)));
}
