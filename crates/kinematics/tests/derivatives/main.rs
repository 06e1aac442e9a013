//! Derivatives against dual numbers: Jacobians of every kind, what a Jacobian becomes by one
//! coordinate and in time, and what every parameter of a table and of screws does to the tip. Dual
//! numbers carry derivatives exactly, so that only rounding remains.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

#[path = "../../../../tests/support/corpus.rs"]
mod corpus;
mod duals;
mod jacobians;
mod parameters;
#[path = "../support/mod.rs"]
mod support;

use std::{fs, path::PathBuf};

use congruent_description::{RobotDescription, load_robot};
use congruent_kinematics::Twist;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

/// The robots that come with the project, and those of the corpus where this run has one.
fn robots() -> Vec<RobotDescription> {
    let folders = |root: PathBuf| {
        let entries = fs::read_dir(root.join("robots")).unwrap().flatten().map(|entry| entry.path());
        let mut folders: Vec<_> = entries.filter(|path| path.is_dir()).collect();
        folders.sort();
        folders
    };
    let mut robots: Vec<_> =
        folders(corpus::workspace()).iter().map(|folder| load_robot(folder).unwrap()).collect();
    assert_eq!(robots.len(), 7);
    if let Some(corpus) = corpus::corpus() {
        let urdfs = folders(corpus).into_iter().map(|folder| folder.join("robot.urdf"));
        robots.extend(urdfs.map(|urdf| load_robot(&urdf).unwrap()));
        assert_eq!(robots.len(), 16);
    }
    robots
}

/// Numbers between -3 and 3, the same in every run.
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    let mut number = || (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 * 6.0 - 3.0;
    (0..count).map(|_| number()).collect()
}

fn apart(a: &Twist, b: &Twist) -> f64 {
    (a.angular - b.angular).norm().max((a.linear - b.linear).norm())
}
