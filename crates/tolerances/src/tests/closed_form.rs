//! A planar arm of two links, by hand; and how the two methods agree.

use congruent_description::{
    DeclaredTolerances, ErrorDistribution, ParameterTolerances, RequestedTolerance, RobotQList,
};
use nalgebra::DMatrix;

use super::{drawn, of_rows, robot, robot_q};
use crate::{
    first_order::ScaledColumns,
    norm_quantile::NormDistribution,
    parameters::declared,
    report::{ToleranceSource, ToleranceVerdict},
    spread::{ErrorDraws, ErrorSpread},
    study::{StudyOptions, tolerance_study},
};

/// Rounding of a few products, relative.
const ROUNDING: f64 = 1e-12;

fn options(samples: usize) -> StudyOptions {
    StudyOptions {
        source: ToleranceSource::Options,
        given: None,
        random: 200,
        samples,
        seed: 0,
        required: RequestedTolerance::default(),
    }
}

/// Links a1, a2 and angles theta1, theta2 with standard deviations s, t: the variance of the position is
/// `2 s^2 + t^2 (a1^2 + a2^2 + 2 a1 a2 cos q2) + t^2 a2^2`.
#[test]
fn a_planar_arm_by_hand() {
    let description = robot("robots/planar_2r");
    let rows = &description.dh.as_ref().unwrap().rows;
    let (a1, a2) = (rows[0].a_m, rows[1].a_m);
    assert!(description.tip_from_tcp.is_none());
    let (s, t) = (1e-4, 2e-4);
    let tolerances = DeclaredTolerances {
        general: ParameterTolerances { a_m: Some(s), theta_rad: Some(t), ..ParameterTolerances::default() },
        distribution: ErrorDistribution::Normal { sigmas: 1.0 },
        ..DeclaredTolerances::default()
    };
    let tolerated = declared(&description, &tolerances).unwrap();
    for q2 in [0.0, 0.7, -2.0] {
        let alone = RobotQList::from(&robot_q(&description, &[0.4, q2]));
        let columns = ScaledColumns::new(&tolerated, &alone);
        let found = columns.errors(&tolerated, &NormDistribution::new());
        let square =
            2.0 * s * s + t * t * (a1 * a1 + a2 * a2 + 2.0 * a1 * a2 * f64::cos(q2)) + t * t * a2 * a2;
        assert!((found.rms_m / square.sqrt() - 1.0).abs() < ROUNDING, "{} {}", found.rms_m, square.sqrt());
        assert!((found.rms_rad / (t * 2_f64.sqrt()) - 1.0).abs() < ROUNDING, "{}", found.rms_rad);
        let parts = columns.parts_m2(&tolerated);
        // theta1, a1, theta2, a2.
        let by_hand =
            [t * t * (a1 * a1 + a2 * a2 + 2.0 * a1 * a2 * f64::cos(q2)), s * s, t * t * a2 * a2, s * s];
        for (part, by_hand) in parts.iter().zip(by_hand) {
            assert!((part / by_hand - 1.0).abs() < ROUNDING, "{part} {by_hand}");
        }
    }
}

/// Of small errors the rms of both methods differs by chance alone, and halving all tolerances halves the error.
#[test]
fn both_methods_agree_and_errors_are_proportional() {
    let description = robot("robots/ur5e");
    let found = tolerance_study(&description, &declared(&description, &of_rows()).unwrap(), &options(50_000))
        .unwrap();
    for levels in [&found.overall, &found.worst.levels] {
        assert!(levels.standard_errors_apart < 4.0, "{levels:?}");
        // A sum of many uniform errors is nearly normal, with a shorter tail.
        let (linear, drawn) = (&levels.first_order, &levels.monte_carlo);
        assert!(drawn.p997_m < linear.p997_m && drawn.p997_m > 0.8 * linear.p997_m, "{levels:?}");
    }
    assert!(found.worst.levels.first_order.rms_m >= found.overall.first_order.rms_m);
    let total: f64 = found.parameters.iter().map(|of| of.share).sum();
    assert!((total - 1.0).abs() < 1e-9, "{total}");
    assert!(found.parameters.is_sorted_by(|a, b| a.share >= b.share));
    // All parameters together: a change of every tolerance by 1 % changes the error by 1 %.
    let gain = |of: &crate::ParameterShare| {
        let step = if of.tolerance > 1e-4 { 1e-3_f64.to_radians() } else { 1e-6 };
        of.gain_per_step_m * of.tolerance / step
    };
    let gains: f64 = found.parameters.iter().map(gain).sum();
    assert!((gains / found.overall.first_order.p95_m - 1.0).abs() < 1e-3, "{gains}");
    assert!(found.halvings.is_sorted_by(|a, b| a.p95_m > b.p95_m));
    let halved = found.halvings[0].p95_m;
    assert!((halved / found.parameters[0].p95_if_halved_m - 1.0).abs() < 1e-6, "{halved}");
}

#[test]
fn the_same_seed_gives_the_same_answer() {
    let description = robot("robots/planar_2r");
    let tolerated = declared(&description, &of_rows()).unwrap();
    let study = || tolerance_study(&description, &tolerated, &options(2_000)).unwrap();
    assert_eq!(study(), study());
}

#[test]
fn a_requirement_is_judged_by_the_quantile_and_by_the_certificate() {
    let description = robot("robots/ur5e");
    let tolerated = declared(&description, &of_rows()).unwrap();
    let verdict = |limit_m: f64| {
        let required = RequestedTolerance { position_m: Some(limit_m), orientation_rad: None };
        let options = StudyOptions { required, ..options(10_000) };
        tolerance_study(&description, &tolerated, &options).unwrap().requirement.unwrap().verdict
    };
    assert_eq!(verdict(0.5e-3), ToleranceVerdict::Exceeded);
    assert_eq!(verdict(1e-3), ToleranceVerdict::Within);
    assert_eq!(verdict(3e-3), ToleranceVerdict::Certified);
}

/// Draws with a covariance have it, also if it is singular; independent ones stay within their tolerances.
#[test]
fn draws_have_the_covariance() {
    /// Four standard errors of a covariance of 100,000 draws, relative to the deviations.
    const CHANCE: f64 = 0.02;
    let covariance = DMatrix::from_row_slice(3, 3, &[4.0, 2.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 9.0]) * 1e-8;
    let spread = ErrorSpread::of_covariance(&covariance, 3.0);
    let mut draws = ErrorDraws::new(&spread, 1);
    let (mut errors, mut sum) = ([0.0; 3], DMatrix::<f64>::zeros(3, 3));
    for _ in 0..100_000 {
        draws.draw(&mut errors);
        sum += DMatrix::from_fn(3, 3, |row, column| errors[row] * errors[column] / 1e5);
    }
    for (found, given) in sum.iter().zip(covariance.iter()) {
        assert!((found - given).abs() < CHANCE * 9e-8, "{sum} {covariance}");
    }
    let uniform = ErrorSpread::independent(vec![0.5, 2.0], ErrorDistribution::Uniform);
    let mut draws = ErrorDraws::new(&uniform, 1);
    let mut errors = [0.0; 2];
    for _ in 0..1000 {
        draws.draw(&mut errors);
        assert!(errors[0].abs() <= 0.5 && errors[1].abs() <= 2.0, "{errors:?}");
    }
}

/// The variance with a covariance that has no correlation is that of independent errors.
#[test]
fn a_diagonal_covariance_is_independent() {
    let description = robot("robots/ur5e");
    let mut tolerated = declared(&description, &of_rows()).unwrap();
    let list = drawn(&description, 3).iter().fold(RobotQList::new(description.robot.dof()), |mut list, q| {
        list.push(q);
        list
    });
    let norm = NormDistribution::new();
    let columns = ScaledColumns::new(&tolerated, &list);
    let (independent, parts) = (columns.errors(&tolerated, &norm), columns.parts_m2(&tolerated));
    let variances = tolerated.spread.deviations.iter().map(|each| each * each);
    let covariance = DMatrix::from_diagonal(&nalgebra::DVector::from_iterator(24, variances));
    tolerated.spread = ErrorSpread::of_covariance(&covariance, 3.0);
    let correlated = columns.errors(&tolerated, &norm);
    assert!((correlated.rms_m / independent.rms_m - 1.0).abs() < ROUNDING);
    for (part, other) in columns.parts_m2(&tolerated).iter().zip(&parts) {
        assert!((part - other).abs() < ROUNDING * independent.rms_m.powi(2));
    }
}

/// An angle is judged where the angle is largest: at the configuration of the largest distance 99.7 % of a UR5e with joints of
/// 0.02 deg are within 0.0572 deg, and elsewhere within 0.066 deg.
#[test]
fn a_requirement_of_the_angle_is_judged_where_the_angle_is_largest() {
    let theta =
        ParameterTolerances { theta_rad: Some(0.02_f64.to_radians()), ..ParameterTolerances::default() };
    let tolerances = DeclaredTolerances { general: theta, ..DeclaredTolerances::default() };
    let description = robot("robots/ur5e");
    let required = RequestedTolerance { position_m: None, orientation_rad: Some(0.06_f64.to_radians()) };
    let report = tolerance_study(
        &description,
        &declared(&description, &tolerances).unwrap(),
        &StudyOptions { required, ..options(100_000) },
    )
    .unwrap();
    let requirement = report.requirement.unwrap();
    assert_eq!(requirement.verdict, ToleranceVerdict::Exceeded);
    assert!(
        (requirement.p997_rad.to_degrees() - 0.066).abs() < 1e-3,
        "{}",
        requirement.p997_rad.to_degrees()
    );
    for level in [&report.overall, &report.worst.levels, &report.worst_orientation.levels] {
        assert!(level.monte_carlo.p997_rad <= requirement.p997_rad);
        assert!(level.monte_carlo.p997_m <= requirement.p997_m);
    }
}
