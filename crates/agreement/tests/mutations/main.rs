//! The mutation benchmark: every cause, several magnitudes, every robot at hand, against its own
//! unmutated model. A reduced grid runs with the tests; the full one prints its confusion matrix:
//! `cargo test --release -p congruent-agreement --test mutations -- --ignored --nocapture`.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

mod certificates;
mod faults;
mod matrix;
mod robots;

use congruent_agreement::diagnosis::{Criterion, ModelPair, diagnose};
use congruent_description::Tolerance;
use faults::InjectedFault;
use matrix::{Matrix, Outcome};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};
use robots::Mutable;

/// The default tolerance of robot files.
const TOLERANCE: f64 = 1e-9;
/// A millimetre and a milliradian: so loose that wrong explanations reach it as well.
const LOOSE_TOLERANCE: f64 = 1e-3;
/// Part of the pairs that must be explained.
const PAIRS_EXPLAINED: f64 = 0.95;

/// Configurations within three radians and half a metre.
fn criterion(joints: usize, tolerance: f64) -> Criterion {
    let mut generator = ChaCha8Rng::seed_from_u64(3);
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    let mut unit = || (generator.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
    let configurations = (0..16).map(|_| (0..joints).map(|_| 2.9 * unit()).collect()).collect();
    Criterion {
        tolerance: Tolerance { position_m: tolerance, orientation_rad: tolerance },
        configurations,
        ..Criterion::default()
    }
}

/// Injects faults and evaluates the diagnosis; `None` if the faults change nothing beyond the tolerance.
fn judge(models: &ModelPair, faults: &[&InjectedFault], tolerance: f64) -> Option<Outcome> {
    let criterion = criterion(models.reference.joint_count(), tolerance);
    let mut mutated = models.clone();
    for fault in faults {
        fault.inject(&mut mutated);
    }
    if mutated.residual(&criterion).is_within(&criterion.tolerance) {
        return None;
    }
    Some(Outcome::from_diagnosis(&diagnose(&mutated, &criterion), faults))
}

/// Every `stride`th single fault of every robot.
fn singles(stride: usize, tolerance: f64) -> Matrix {
    let mut matrix = Matrix::default();
    for Mutable { name, models, .. } in robots::all() {
        for fault in faults::all(&models).iter().step_by(stride) {
            if let Some(outcome) = judge(&models, &[fault], tolerance) {
                matrix.count(&name, &[fault], &outcome);
            }
        }
    }
    matrix
}

/// Seeded pairs of faults, `each` for every robot.
fn pairs(each: usize) -> Matrix {
    let mut matrix = Matrix::default();
    let mut generator = ChaCha8Rng::seed_from_u64(7);
    for Mutable { name, models, .. } in robots::all() {
        let faults = faults::all(&models);
        let mut any = || {
            let index = generator.next_u64() % u64::try_from(faults.len()).unwrap();
            &faults[usize::try_from(index).unwrap()]
        };
        for _ in 0..each {
            let pair = [any(), any()];
            if let Some(outcome) = judge(&models, &pair, TOLERANCE) {
                matrix.count(&name, &pair, &outcome);
            }
        }
    }
    matrix
}

#[test]
fn unmutated_pairs_raise_no_alarm() {
    for Mutable { name, models, .. } in robots::all() {
        let criterion = criterion(models.reference.joint_count(), TOLERANCE);
        let diagnosis = diagnose(&models, &criterion);
        assert!(diagnosis.explanations.is_empty(), "{name}: {:?}", models.residual(&criterion));
    }
}

#[test]
fn every_single_fault_is_named() {
    let matrix = singles(7, TOLERANCE);
    assert!(matrix.missed().is_empty(), "{matrix}");
}

#[test]
fn every_single_fault_is_named_within_a_loose_tolerance() {
    let matrix = singles(7, LOOSE_TOLERANCE);
    assert!(matrix.missed().is_empty(), "{matrix}");
}

#[test]
fn nearly_every_pair_is_named() {
    let matrix = pairs(1);
    assert!(matrix.explained() >= PAIRS_EXPLAINED, "{matrix}");
}

#[test]
#[ignore = "the full grid takes a minute"]
#[expect(clippy::print_stdout, reason = "the test is run for the matrix")]
fn the_full_grid() {
    for tolerance in [TOLERANCE, LOOSE_TOLERANCE] {
        let matrix = singles(1, tolerance);
        println!("single faults, tolerance {tolerance:e}\n{matrix}");
        assert!(matrix.missed().is_empty());
    }
    let matrix = pairs(20);
    println!("pairs\n{matrix}");
    assert!(matrix.explained() >= PAIRS_EXPLAINED);
}
