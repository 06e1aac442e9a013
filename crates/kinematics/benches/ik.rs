//! Inverse kinematics by the protocol of the comparison of TRAC-IK (Beeson & Ames 2015): random
//! reachable poses, start at the middle of the ranges, 5 ms each, 1e-5 m and rad.
//!
//! `cargo bench -p congruent-kinematics --bench ik -- ROBOT...`: folders with robot.toml, or URDFs;
//! a chain other than the robot's own as `FILE:BASE:TIP`. An arm of fewer than six joints is asked for
//! positions alone.

#![expect(clippy::print_stdout, reason = "a benchmark prints what it measures")]
#![expect(clippy::disallowed_methods, reason = "and looks at the clock")]
#![expect(clippy::cast_precision_loss, reason = "counts are small and draws have 53 bits")]

use std::{
    path::Path,
    time::{Duration, Instant},
};

use congruent_description::{ArmQ, load_robot};
use congruent_kinematics::{Arm, ArmJoint, IkOptions, IkSolver, IkTarget, Pose, TargetPart};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

const POSES: usize = 10_000;
const BUDGET: Duration = Duration::from_millis(5);

fn main() {
    let robots: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let own = ["ur5e", "panda", "rrr_arm"];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots");
    let own = own.map(|name| folder.join(name).display().to_string());
    println!(
        "{:>8} {:>8} {:>10} {:>10} {:>10} {:>10}  arm",
        "solved", "steps", "median us", "mean us", "p99 us", "worst us"
    );
    for robot in if robots.is_empty() { own.to_vec() } else { robots } {
        measure(&robot);
    }
}

fn measure(named: &str) {
    let mut parts = named.split(':');
    let path = parts.next().expect("a name has a first part");
    let description = load_robot(Path::new(path)).expect("the robot loads");
    let link = |name: &str| description.robot.find_link(name).expect("the link exists");
    let (base, tip) = match (parts.next(), parts.next()) {
        (Some(base), Some(tip)) => (link(base), link(tip)),
        _ => (description.base, description.tip),
    };
    let mut arm = Arm::new(&description.robot, base, tip, Pose::identity()).expect("the arm moves");
    let part = if arm.joints().len() < 6 { TargetPart::Position } else { TargetPart::Pose };
    let targets = reachable(&mut arm);
    let middle = arm.middle();
    let mut solver = IkSolver::new(arm);
    let mut times_us = Vec::with_capacity(POSES);
    let (mut solved, mut steps) = (0, 0);
    for (seed, base_from_tcp) in (0..).zip(targets) {
        let options = IkOptions {
            tolerance_m: 1e-5,
            tolerance_rad: 1e-5,
            max_iterations: usize::MAX,
            seed,
            ..IkOptions::default()
        };
        let begun = Instant::now();
        let target = IkTarget { base_from_tcp, part };
        let result = solver.solve(&target, &middle, &options, || begun.elapsed() < BUDGET);
        times_us.push(begun.elapsed().as_secs_f64() * 1e6);
        let result = result.expect("the start is a configuration");
        solved += usize::from(result.converged);
        steps += result.iterations;
    }
    times_us.sort_by(f64::total_cmp);
    let mean = times_us.iter().sum::<f64>() / times_us.len() as f64;
    println!(
        "{:>7.2}% {:>8.1} {:>10.1} {mean:>10.1} {:>10.1} {:>10.1}  {named}, {} joints, {part:?}",
        100.0 * solved as f64 / POSES as f64,
        steps as f64 / POSES as f64,
        times_us[POSES / 2],
        times_us[POSES * 99 / 100],
        times_us[POSES - 1],
        middle.len(),
    );
}

/// Poses at random configurations within the limits.
fn reachable(arm: &mut Arm) -> Vec<Pose> {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut share = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let ranges: Vec<(f64, f64)> = arm.joints().iter().map(ArmJoint::sampled_range).collect();
    (0..POSES)
        .map(|_| {
            let q: ArmQ = ranges.iter().map(|(lower, upper)| lower + (upper - lower) * share()).collect();
            arm.base_from_tcp(&q).expect("the configuration fits")
        })
        .collect()
}
