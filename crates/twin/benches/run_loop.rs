//! The whole run loop of `scenarios/ur5e_pick.toml` (4 s at 1 kHz), one stage more in each benchmark.
//!
//! 4 s divided by a time here is how many times faster than real time it runs.

use std::path::Path;

use congruent_description::Obstacle;
use congruent_monitors::{NoRecorder, Recorder, RunningCheck};
use congruent_twin::{Run, RunSetup};

fn main() {
    divan::main();
}

fn setup() -> RunSetup {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/ur5e_pick.toml");
    RunSetup::load(&path, &[]).expect("the scenario is part of the project")
}

/// What a run does beside physics.
#[derive(Clone, Copy)]
struct Stages {
    compare: bool,
    observe: bool,
}

fn run(setup: &RunSetup, checks: &mut [RunningCheck<'_>], recorder: &mut dyn Recorder, stages: Stages) {
    let mut run = Run::new(setup).expect("the scenario runs");
    for _ in 0..setup.clock.steps.unwrap_or_default() {
        run.step().expect("the physics holds");
        if stages.compare {
            run.compare().expect("model and robot fit");
        }
        if stages.observe {
            run.observe(checks, recorder).expect("nothing is recorded");
        }
    }
}

fn bench(bencher: divan::Bencher<'_, '_>, stages: Stages, checks: fn(&RunningCheck<'_>) -> bool) {
    let setup = setup();
    bencher
        .with_inputs(|| {
            let mut kept = setup.checks();
            kept.retain(checks);
            kept
        })
        .bench_local_values(|mut checks| run(&setup, &mut checks, &mut NoRecorder, stages));
}

#[divan::bench]
fn a_physics(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, Stages { compare: false, observe: false }, |_| false);
}

#[divan::bench]
fn b_and_comparison(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, Stages { compare: true, observe: false }, |_| false);
}

#[divan::bench]
fn c_and_checks_and_clearance(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, Stages { compare: true, observe: true }, |_| true);
}

/// The same with this many obstacles more, all out of the arm's reach, with clearance of all pairs: far obstacles should
/// cost little, in physics as in clearance.
#[divan::bench(args = [10, 1000])]
fn d_with_far_obstacles(bencher: divan::Bencher<'_, '_>, more: u32) {
    let setup = among(more);
    bencher.with_inputs(|| setup.checks()).bench_local_values(|mut checks| {
        run(&setup, &mut checks, &mut NoRecorder, Stages { compare: true, observe: true });
    });
}

/// What the physics alone costs among them, its world and its shapes included.
#[divan::bench(args = [10, 1000])]
fn e_physics_with_far_obstacles(bencher: divan::Bencher<'_, '_>, more: u32) {
    bencher.with_inputs(|| among(more)).bench_local_values(|setup| {
        run(&setup, &mut [], &mut NoRecorder, Stages { compare: false, observe: false });
    });
}

/// The scenario with so many obstacles more, all out of reach.
fn among(more: u32) -> RunSetup {
    let mut setup = setup();
    let near = setup.obstacles[0].clone();
    setup.obstacles.extend((0..more).map(|index| far(&near, index)));
    setup
}

/// A box 4 m away or more.
fn far(like: &Obstacle, index: u32) -> Obstacle {
    let angle = f64::from(index) * 0.1;
    let radius_m = 4.0 + 0.01 * f64::from(index);
    Obstacle {
        name: format!("far_{index}"),
        world_from_obstacle: nalgebra::Isometry3::translation(
            radius_m * angle.cos(),
            radius_m * angle.sin(),
            0.2 * f64::from(index % 10),
        ),
        geometry: like.geometry.clone(),
    }
}
