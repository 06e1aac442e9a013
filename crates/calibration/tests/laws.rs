//! Laws of calibration: exact derivatives, perfect data give the true corrections, unidentifiable corrections are fixed.

#[path = "../../kinematics/tests/support/mod.rs"]
mod support;

use congruent_calibration::estimation::{
    CorrectedChain, Loss, Measurement, Problem, base_pose, fit_robustly, fit_with_estimated_noise, identify,
    joint_axes, tool_pose, zero_offsets,
};
use congruent_description::ChainQ;
use congruent_kinematics::{Pose, ScrewChain, Twist};
use nalgebra::Vector3;
use proptest::prelude::*;

/// Smallest ratio of singular values in these tests.
const THRESHOLD: f64 = 1e-3;

/// A turn, a slide and two more turns, none of them parallel.
fn chain() -> ScrewChain {
    let twist =
        |angular: [f64; 3], linear: [f64; 3]| Twist { angular: angular.into(), linear: linear.into() };
    ScrewChain {
        twists_in_base: vec![
            twist([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            twist([0.0, 0.0, 0.0], [0.6, 0.0, 0.8]),
            twist([0.0, 1.0, 0.0], [-0.3, 0.0, 0.2]),
            twist([1.0, 0.0, 0.0], [0.0, 0.5, -0.1]),
        ],
        base_from_tip_at_zero: twist([0.1, 0.2, 0.3], [0.9, 0.3, 0.2]).exp(1.0),
    }
}

const JOINTS: [&str; 4] = ["pan", "slide", "lift", "roll"];

fn corrected() -> CorrectedChain {
    let chain = chain();
    let sets = [base_pose(), zero_offsets(&chain, &JOINTS), joint_axes(&chain, &JOINTS), tool_pose(&chain)];
    CorrectedChain::new(chain, sets.concat())
}

fn positions() -> impl Strategy<Value = ChainQ> {
    prop::array::uniform4(-1.0..1.0).prop_map(ChainQ::from)
}

fn figures(count: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0, count)
}

fn measured(chain: &CorrectedChain, p: &[f64], q: ChainQ) -> Measurement {
    let pose = chain.base_from_tip(&q, p);
    Measurement {
        q,
        tip_in_base_m: pose.translation.map(Some).into(),
        base_from_tip: Some(pose.rotation),
        camera_from_target: None,
    }
}

/// Deterministic configurations without a random generator: a lattice of irrational steps.
fn spread(rows: u32) -> Vec<ChainQ> {
    let at = |row: u32, joint: u32| 2.4 * ((f64::from(row) * f64::from(joint).sqrt()).fract() - 0.5);
    (1..=rows).map(|row| [2, 3, 5, 7].map(|joint| at(row, joint)).into()).collect()
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn the_derivative_is_that_of_the_pose(q in positions(), p in figures(30), column in 0..30_usize) {
        /// Step of a central difference.
        const STEP: f64 = 1e-5;
        /// Truncation h^2/6 and rounding eps/h within some metres. Worst seen 4.3e-11.
        const CENTRAL_DIFFERENCE: f64 = 2e-10;
        let chain = corrected();
        prop_assert_eq!(chain.parameters().len(), 30);
        let p: Vec<f64> = p.into_iter().map(|figure| figure * 0.2).collect();
        let mut twists = vec![Twist { angular: Vector3::zeros(), linear: Vector3::zeros() }; p.len()];
        let pose = chain.linearise(&q, &p, &mut twists);
        let moved = |by: f64| {
            let mut p = p.clone();
            p[column] += by;
            Twist::log(&(chain.base_from_tip(&q, &p) * pose.inverse()))
        };
        let (ahead, behind) = (moved(STEP), moved(-STEP));
        let angular = (ahead.angular - behind.angular) / (2.0 * STEP);
        let linear = (ahead.linear - behind.linear) / (2.0 * STEP);
        prop_assert!(support::within((angular - twists[column].angular).norm(), CENTRAL_DIFFERENCE));
        prop_assert!(support::within((linear - twists[column].linear).norm(), CENTRAL_DIFFERENCE));
    }

    #[test]
    fn perfect_data_leave_rounding_and_give_the_corrections_back(truth in figures(30)) {
        /// Rounding within 2 m, times the condition of the problem. Worst seen 3.0e-15.
        const ROUNDING: f64 = 1e-12;
        let chain = corrected();
        let nothing = vec![0.0; 30];
        let nominal: Vec<Measurement> = spread(24).into_iter().map(|q| measured(&chain, &nothing, q)).collect();
        let found = identify(&Problem { chain: &chain, measurements: &nominal }, THRESHOLD);
        // Complete and minimal: four for a turn, two for a slide, six; Everett & Hsu (1988).
        prop_assert_eq!(found.kept.len(), 4 * 3 + 2 + 6);
        let mut p = nothing;
        for &at in &found.kept {
            p[at] = 0.02 * truth[at];
        }
        let measurements: Vec<Measurement> = spread(24).into_iter().map(|q| measured(&chain, &p, q)).collect();
        let problem = Problem { chain: &chain, measurements: &measurements };
        let fit = fit_with_estimated_noise(&problem, &found.kept);
        for (found, truth) in fit.corrections.iter().zip(&p) {
            prop_assert!(support::within((found - truth).abs(), ROUNDING));
        }
        let worst = fit.residuals.iter().map(|each| each.position_m.norm()).fold(0.0, f64::max);
        prop_assert!(support::within(worst, ROUNDING));
        let robust = fit_robustly(&problem, &found.kept, Loss::Tukey, &fit, None);
        prop_assert!(robust.outliers.is_empty());
    }
}

#[test]
fn unidentifiable_corrections_are_fixed_and_named() {
    let chain = corrected();
    let nothing = vec![0.0; 30];
    let measurements: Vec<Measurement> =
        spread(24).into_iter().map(|q| measured(&chain, &nothing, q)).collect();
    let problem = Problem { chain: &chain, measurements: &measurements };
    let found = identify(&problem, THRESHOLD);
    let name = |at: usize| chain.parameters()[at].name.as_str();
    let yaw = found.fixed.iter().find(|each| name(each.parameter) == "base.yaw").unwrap();
    let correlated_with: Vec<&str> = yaw.correlated_with.iter().map(|&(at, _)| name(at)).collect();
    assert_eq!(correlated_with, ["pan.zero"]);
    assert!((yaw.correlated_with[0].1 - 1.0).abs() < 1e-9 && yaw.unexplained_share < 1e-6, "{yaw:?}");
    let fit = fit_with_estimated_noise(&problem, &found.kept);
    for fixed in &found.fixed {
        assert_eq!(fit.corrections[fixed.parameter].to_bits(), 0, "{} moved", name(fixed.parameter));
    }
    // A single configuration determines six parameters at most.
    let one = Problem { chain: &chain, measurements: &measurements[..1] };
    assert_eq!(identify(&one, THRESHOLD).kept.len(), 6);
}

#[test]
fn without_corrections_it_is_the_chain() {
    let (chain, q) = (corrected(), ChainQ::from([0.3, -0.2, 0.5, 1.1]));
    let expected: Pose = chain.nominal().base_from_tip(&q).unwrap();
    assert!(chain.base_from_tip(&q, &[0.0; 30]).distance_m(&expected) < 1e-15);
}
