//! Steps per second of a lumped six-joint arm under each controller: `cargo bench -p
//! congruent-simulation`. One item is one step of 1 ms.

#[path = "../tests/support/mod.rs"]
mod support;

use congruent_simulation::{Setpoint, World, WorldSettings};
use divan::{Bencher, counter::ItemsCount};
use nalgebra::Isometry3;
use support::{arm, arm_q0, make};

/// Steps in one sample: enough that the clock does not count, few enough to stay near the start.
const STEPS: usize = 500;

fn main() {
    divan::main();
}

#[divan::bench(args = ["passive", "kinematic", "pd", "gravity_compensation"])]
fn step(bencher: Bencher<'_, '_>, kind: &str) {
    let mut world = World::new(&arm(), &WorldSettings::default()).expect("the arm is a robot");
    let mut controller = make(kind, 400.0, 40.0);
    let q0 = arm_q0();
    let setpoint = Setpoint { q: &q0, qd: &[0.0; 6], qdd: &[0.0; 6] };
    world.set_state(&q0, &[0.0; 6]).expect("the state fits");
    let start = world.snapshot();
    bencher.counter(ItemsCount::new(STEPS)).bench_local(|| {
        world.restore(&start);
        for _ in 0..STEPS {
            world.step(controller.as_mut(), &setpoint).expect("the arm steps");
        }
    });
}

#[divan::bench]
fn poses(bencher: Bencher<'_, '_>) {
    let robot = arm();
    let world = World::new(&robot, &WorldSettings::default()).expect("the arm is a robot");
    let mut poses = vec![Isometry3::identity(); robot.links().len()];
    bencher.bench_local(|| world.root_from_links_into(divan::black_box(&mut poses)));
}
