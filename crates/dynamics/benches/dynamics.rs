//! What one evaluation costs on real arms of the corpus; without a corpus, on the UR5e of `robots/`.

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use std::path::PathBuf;

use congruent_description::{RobotQ, load_robot};
use congruent_dynamics::{BodyTree, DrivenState, JointMotionState, JointMotions, Rollout};
use divan::{Bencher, black_box};
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

fn iiwa() -> BodyTree {
    let path = std::env::var_os("CONGRUENT_CORPUS").map_or_else(
        || corpus::workspace().join("robots/ur5e"),
        |corpus| PathBuf::from(corpus).join("robots/iiwa14/robot.urdf"),
    );
    BodyTree::new(&load_robot(&path).expect("the robot is valid").robot)
}

/// Values that are not special.
fn values(tree: &BodyTree, phase: f64) -> Vec<f64> {
    (0..tree.dof())
        .scan(phase, |value, _| {
            *value = (*value * 7.3).sin();
            Some(*value)
        })
        .collect()
}

#[divan::bench]
fn inverse(bencher: Bencher<'_, '_>) {
    let tree = iiwa();
    let (q, qd, qdd) = (RobotQ::from(values(&tree, 0.3)), values(&tree, 0.4), values(&tree, 0.5));
    let (mut buffer, mut tau) = (tree.buffer(), vec![0.0; tree.dof()]);
    bencher.bench_local(|| {
        tree.inverse_into(black_box(&JointMotionState { q: &q, qd: &qd, qdd: &qdd }), &mut buffer, &mut tau)
    });
}

/// The time of one batch; divided by its samples, `items` is that of one.
#[divan::bench(args = [8, 1024])]
fn inverse_many(bencher: Bencher<'_, '_>, samples: usize) {
    let tree = iiwa();
    let many = |phase: f64| -> Vec<f64> {
        let phases = (0_u32..).map(|sample| phase + 0.01 * f64::from(sample)).take(samples);
        phases.flat_map(|phase| values(&tree, phase)).collect()
    };
    let (q, qd, qdd) = (many(0.3), many(0.4), many(0.5));
    let (mut buffer, mut tau) = (tree.batch_buffer(), vec![0.0; samples * tree.dof()]);
    bencher.counter(divan::counter::ItemsCount::new(samples)).bench_local(|| {
        let motions = JointMotions { q: &q, qd: &qd, qdd: &qdd };
        tree.inverse_many_into(black_box(&motions), &mut buffer, &mut tau)
    });
}

#[divan::bench]
fn mass_matrix(bencher: Bencher<'_, '_>) {
    let tree = iiwa();
    let q = RobotQ::from(values(&tree, 0.3));
    let (mut buffer, mut matrix) = (tree.buffer(), DMatrix::zeros(tree.dof(), tree.dof()));
    bencher.bench_local(|| tree.mass_matrix_into(black_box(&q), &mut buffer, &mut matrix));
}

#[divan::bench]
fn forward(bencher: Bencher<'_, '_>) {
    let tree = iiwa();
    let (q, qd, tau) = (RobotQ::from(values(&tree, 0.3)), values(&tree, 0.4), values(&tree, 0.5));
    let (mut buffer, mut qdd) = (tree.buffer(), vec![0.0; tree.dof()]);
    bencher.bench_local(|| {
        tree.forward_into(black_box(&DrivenState { q: &q, qd: &qd, tau: &tau }), &mut buffer, &mut qdd)
    });
}

#[divan::bench]
fn rollout_step(bencher: Bencher<'_, '_>) {
    let tree = iiwa();
    let mut rollout =
        Rollout::new(&tree, RobotQ::from(values(&tree, 0.3)), vec![0.0; tree.dof()]).expect("lengths agree");
    bencher.bench_local(|| rollout.step(black_box(1e-6), |_, _, _, tau| tau.fill(0.0)));
}
