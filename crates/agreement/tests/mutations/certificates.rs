//! The certificate on injected faults: how many brackets close, and the time that they take.
//! `cargo test --release -p congruent-agreement --test mutations certificates -- --ignored --nocapture`;
//! `CONGRUENT_EACH` says how many faults of each robot.

use congruent_agreement::{
    bound::{Bracket, Budget, Certificate, DrivenScrews, certify_driven},
    diagnosis::{ModelPair, ReferenceModel},
};
use congruent_description::ChainQ;
use congruent_kinematics::ScrewChain;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use crate::{
    faults::{self, InjectedFault},
    robots::{self, Mutable},
};

/// The relative gap that a bracket must reach.
const WITHIN: f64 = 0.05;

/// The certificate of a mutated model against its reference.
fn certificate(models: &ModelPair, ranges: &[(f64, f64)], budget: Budget) -> Certificate {
    let ReferenceModel { joints } = &models.reference;
    let joints = joints.iter().filter(|joint| joint.twist_in_joint.is_some()).count();
    let rows: Vec<usize> = models.candidate.rows.iter().map(|row| row.joint).collect();
    let candidate = ScrewChain::identify(joints, |values| {
        let mut q = ChainQ::zeros(joints);
        rows.iter().zip(values).for_each(|(&joint, &value)| q[joint] = value);
        models.candidate.base_from_tip(&q)
    });
    let in_order: Vec<usize> = (0..joints).collect();
    let candidate = DrivenScrews { chain: candidate, drivers: rows };
    let reference = DrivenScrews { chain: models.reference.screws(), drivers: in_order };
    certify_driven(&candidate, &reference, ranges, budget).unwrap()
}

fn pick<'a>(faults: &'a [InjectedFault], generator: &mut ChaCha8Rng) -> &'a InjectedFault {
    let index = generator.next_u64() % u64::try_from(faults.len()).unwrap();
    &faults[usize::try_from(index).unwrap()]
}

/// `each` single faults and as many pairs of every robot.
fn sample(each: usize) -> Vec<(String, Mutable)> {
    let mut generator = ChaCha8Rng::seed_from_u64(11);
    let mut list = Vec::new();
    for Mutable { name, models, ranges } in robots::all() {
        let faults = faults::all(&models);
        for number in 0..2 * each {
            let chosen: Vec<&InjectedFault> =
                (0..=number % 2).map(|_| pick(&faults, &mut generator)).collect();
            let mut models = models.clone();
            for fault in &chosen {
                fault.inject(&mut models);
            }
            let named: Vec<String> =
                chosen.iter().map(|fault| format!("{} {:?}", fault.cause, fault.place)).collect();
            let label = format!("{name}: {}", named.join(" and "));
            list.push((label, Mutable { name: name.clone(), models, ranges: ranges.clone() }));
        }
    }
    list
}

fn excess(bracket: &Bracket) -> f64 {
    if bracket.is_within(WITHIN) { 0.0 } else { bracket.certified / bracket.attained - 1.0 }
}

#[test]
#[ignore = "takes minutes; lists brackets that do not close"]
#[expect(clippy::print_stdout, reason = "the test is run for the list")]
#[expect(clippy::disallowed_methods, reason = "the test measures time")]
fn certificates_close() {
    let each = std::env::var("CONGRUENT_EACH").map_or(4, |text| text.parse().unwrap());
    let mut slowest = 0.0_f64;
    let (mut all, mut open) = (0, 0);
    let mut total = 0.0;
    for (label, Mutable { models, ranges, .. }) in sample(each) {
        let start = std::time::Instant::now();
        let found = certificate(&models, &ranges, Budget::default());
        let seconds = start.elapsed().as_secs_f64();
        total += seconds;
        slowest = slowest.max(seconds);
        all += 1;
        let (position, orientation) = (excess(&found.position_m), excess(&found.orientation_rad));
        if position > 0.0 || orientation > 0.0 || seconds > 2.0 {
            open += 1;
            println!(
                "{label}: {:.1} % of {:.4} m ({} boxes), {:.1} % of {:.4} rad ({} boxes), {seconds:.1} s",
                1e2 * position,
                found.position_m.attained,
                found.position_m.boxes,
                1e2 * orientation,
                found.orientation_rad.attained,
                found.orientation_rad.boxes,
            );
        }
    }
    println!("{open} of {all} open or slow, slowest {slowest:.1} s, {total:.0} s in all");
}
