//! The certificate: closed forms, and laws on random chains.

#[path = "../../kinematics/tests/support/mod.rs"]
mod support;

use std::f64::consts::PI;

use congruent_agreement::bound::{Bracket, Budget, Certificate, DrivenScrews, certify, certify_driven};
use congruent_description::{ChainQ, DhConvention};
use congruent_kinematics::{DhChain, KinematicsError, Pose, ScrewChain, Twist};
use nalgebra::{Isometry3, Vector3};
use proptest::prelude::*;

use support::{RowFigures, TableFigures, panda_table, ur5e_table};

/// Brackets against closed forms that need no splitting. Unit: m or rad; kind: rounding, which the
/// certificate derives from the size of the chain, doubled for each joint of a box of full turns; worst
/// seen 1.4e-11.
const ROUNDING: f64 = 4e-11;
/// Rounding of the forward kinematics of samples; no sample exceeds it.
const SAMPLE_ROUNDING: f64 = 1e-13;
/// Sum of six screws' rounding times the reach and half a turn, m or rad; worst seen 4.0e-14.
const IDENTIFIED: f64 = 1e-12;
const TURN: (f64, f64) = (-PI, PI);

fn planar(second_m: f64) -> TableFigures {
    TableFigures::new(
        DhConvention::Standard,
        &[RowFigures::revolute(0.6, 0.0, 0.0), RowFigures::revolute(second_m, 0.0, 0.0)],
    )
}

fn chain(figures: &TableFigures) -> ScrewChain {
    let robot = figures.robot();
    ScrewChain::from_dh(&DhChain::new(&figures.table(&robot), &robot), robot.dof())
        .expect("the table fits its robot")
}

fn changed(figures: &TableFigures, change: impl FnOnce(&mut TableFigures)) -> TableFigures {
    let mut figures = figures.clone();
    change(&mut figures);
    figures
}

fn certificate(a: &TableFigures, b: &TableFigures) -> Certificate {
    let ranges = vec![TURN; a.rows.len()];
    certify(&chain(a), &chain(b), &ranges, Budget::default()).expect("as many ranges as joints")
}

#[track_caller]
fn assert_exact(bracket: &Bracket, expected: f64) {
    assert!(support::within((bracket.attained - expected).abs(), ROUNDING), "{bracket:?}, not {expected}");
    assert!(support::within((bracket.certified - expected).abs(), ROUNDING), "{bracket:?}, not {expected}");
}

/// Attained is the closed form, and certified is not far above it.
#[track_caller]
fn assert_close(bracket: &Bracket, expected: f64) {
    /// The local search ends if steps of 1e-8 of a turn change nothing; relative, worst seen 3e-9.
    const LOCAL_SEARCH: f64 = 1e-6;
    assert!((bracket.attained - expected).abs() <= LOCAL_SEARCH * expected, "{bracket:?}, not {expected}");
    assert!(bracket.attained <= bracket.certified);
    assert!(bracket.is_within(Budget::default().relative_gap), "{bracket:?}");
}

#[test]
fn equal_chains_are_zero_apart() {
    let certificate = certificate(&ur5e_table(), &ur5e_table());
    assert!(certificate.position_m.certified <= 0.0);
    assert!(certificate.orientation_rad.certified <= 0.0);
}

#[test]
fn one_robot_written_twice_is_certified_at_rounding_level() {
    let robot = ur5e_table().robot();
    let (base, tip) = (robot.root(), robot.find_link("tip").unwrap());
    let urdf = ScrewChain::from_urdf(&robot, base, tip, &[0, 1, 2, 3, 4, 5]).unwrap();
    let certificate = certify(&chain(&ur5e_table()), &urdf, &[TURN; 6], Budget::default()).unwrap();
    assert!(support::within(certificate.position_m.certified, IDENTIFIED));
    assert!(support::within(certificate.orientation_rad.certified, IDENTIFIED));
    assert_eq!((certificate.position_m.boxes, certificate.orientation_rad.boxes), (0, 0));
}

#[test]
fn a_tool_offset_is_its_length_everywhere() {
    let off = changed(&ur5e_table(), |arm| arm.dhn_from_tip = Isometry3::translation(0.003, 0.0, 0.004));
    let certificate = certificate(&off, &ur5e_table());
    assert_exact(&certificate.position_m, 0.005);
    assert!(certificate.orientation_rad.certified <= ROUNDING);
}

#[test]
fn a_shifted_base_is_its_shift_everywhere() {
    let off = changed(&ur5e_table(), |arm| arm.base_from_dh0 = Isometry3::translation(0.0, 0.002, 0.0));
    assert_exact(&certificate(&off, &ur5e_table()).position_m, 0.002);
}

#[test]
fn a_link_length_is_the_same_everywhere() {
    let off = changed(&ur5e_table(), |arm| arm.rows[2].a_m += 0.001);
    assert_exact(&certificate(&off, &ur5e_table()).position_m, 0.001);
}

#[test]
fn a_zero_offset_of_a_planar_arm_is_worst_at_full_reach() {
    let offset_rad = 1_f64.to_radians();
    let off = changed(&planar(0.4), |arm| arm.rows[0].theta_rad += offset_rad);
    let certificate = certificate(&off, &planar(0.4));
    assert_close(&certificate.position_m, 2.0 * (offset_rad / 2.0).sin());
    assert_exact(&certificate.orientation_rad, offset_rad);
}

#[test]
fn limits_count() {
    // The elbow never comes straighter than a right angle: the reach is the diagonal.
    let off = changed(&planar(0.4), |arm| arm.rows[0].theta_rad += 0.01);
    let ranges = [TURN, (PI / 2.0, PI)];
    let certificate = certify(&chain(&off), &chain(&planar(0.4)), &ranges, Budget::default()).unwrap();
    assert_close(&certificate.position_m, 2.0 * (0.01_f64 / 2.0).sin() * 0.52_f64.sqrt());
    assert!(certificate.position_m.at[1] >= PI / 2.0);
}

#[test]
fn a_turned_base_is_worst_at_full_reach() {
    // The arm stretched across the tilt's axis.
    let tilt = Isometry3::rotation(Vector3::new(0.01, 0.0, 0.0));
    let off = changed(&planar(0.4), |arm| arm.base_from_dh0 = tilt);
    let certificate = certificate(&off, &planar(0.4));
    assert_close(&certificate.position_m, 2.0 * (0.01_f64 / 2.0).sin());
    assert_exact(&certificate.orientation_rad, 0.01);
}

#[test]
fn a_flipped_joint_is_half_a_turn_off_and_no_more() {
    let off = changed(&planar(0.4), |arm| arm.rows[1].sign = -1.0);
    let certificate = certificate(&off, &planar(0.4));
    assert_close(&certificate.position_m, 0.8);
    assert_exact(&certificate.orientation_rad, PI);
}

#[test]
fn a_joint_that_moves_twice_as_far() {
    // One joint at distance 1: the difference is the chord of q, which is 2 at half a turn.
    let turn = |rate: f64| ScrewChain {
        twists_in_base: vec![Twist { angular: Vector3::z() * rate, linear: Vector3::zeros() }],
        base_from_tip_at_zero: Pose { translation: Vector3::x(), ..Pose::identity() },
    };
    let certificate = certify(&turn(1.0), &turn(2.0), &[TURN], Budget::default()).unwrap();
    assert_close(&certificate.position_m, 2.0);
    assert_exact(&certificate.orientation_rad, PI);
    let small = certify(&turn(1.0), &turn(1.0 + 1e-6), &[TURN], Budget::default()).unwrap();
    assert_close(&small.position_m, 1e-6 * PI);
}

/// An arm with the lengths of a Panda, in its limits: seven joints, of which all matter.
fn seven_joints() -> (TableFigures, Vec<(f64, f64)>) {
    let limits =
        [(-2.9, 2.9), (-1.76, 1.76), (-2.9, 2.9), (-3.07, -0.07), (-2.9, 2.9), (-0.02, 3.75), (-2.9, 2.9)];
    (panda_table(), limits.to_vec())
}

#[test]
fn a_wrong_base_and_a_wrong_tool_add_up() {
    let (arm, ranges) = seven_joints();
    let off = changed(&arm, |arm| {
        arm.base_from_dh0 = Isometry3::translation(0.01, 0.02, -0.02);
        arm.dhn_from_tip = Isometry3::translation(0.0, 0.03, 0.04);
    });
    let position_m = certify(&chain(&off), &chain(&arm), &ranges, Budget::default()).unwrap().position_m;
    assert_close(&position_m, 0.03 + 0.05);
}

#[test]
fn a_small_turn_beside_a_large_one_adds_up_too() {
    let (arm, ranges) = seven_joints();
    let off = changed(&arm, |arm| {
        arm.base_from_dh0 = Isometry3::rotation(Vector3::x() * 1.9);
        arm.dhn_from_tip = Isometry3::rotation(Vector3::z() * 1e-4);
    });
    let certificate = certify(&chain(&off), &chain(&arm), &ranges, Budget::default()).unwrap();
    assert_close(&certificate.orientation_rad, 1.9 + 1e-4);
}

#[test]
fn a_turned_base_of_twelve_joints_is_worst_at_full_reach() {
    // All axes parallel but the last, which lies across: stretched, the arm is 2.4 m long.
    let mut rows = vec![RowFigures::revolute(0.2, 0.0, 0.0); 12];
    rows[10].alpha_rad = PI / 2.0;
    let arm = TableFigures::new(DhConvention::Standard, &rows);
    let off = changed(&arm, |arm| arm.base_from_dh0 = Isometry3::rotation(Vector3::y() * 0.01));
    let certificate = certificate(&off, &arm);
    assert_close(&certificate.position_m, 2.0 * (0.01_f64 / 2.0).sin() * 2.4);
    assert_close(&certificate.orientation_rad, 0.01);
}

#[test]
fn a_joint_in_degrees_is_worst_at_its_furthest_reach_on_both_sides() {
    // Joint 2 turns 57 times as fast, about the axis from which elbow and tool have a distance.
    let fast = changed(&planar(0.4), |arm| arm.rows[0].sign = 180.0 / PI);
    assert_close(&certificate(&fast, &planar(0.4)).position_m, 2.0);
}

#[test]
fn a_sliding_joint_is_exact() {
    let slide = |x: f64| ScrewChain {
        twists_in_base: vec![Twist { angular: Vector3::zeros(), linear: Vector3::new(x, 0.0, 1.0) }],
        base_from_tip_at_zero: Pose::identity(),
    };
    let certificate = certify(&slide(0.0), &slide(0.01), &[(-0.1, 0.5)], Budget::default()).unwrap();
    assert_exact(&certificate.position_m, 0.005);
    assert_eq!(certificate.position_m.at, [0.5]);
}

#[test]
fn more_than_one_turn_repeats_itself() {
    let off = changed(&planar(0.4), |arm| arm.rows[1].theta_rad += 0.01);
    let ranges = [(-2.0 * PI, 2.0 * PI), (-9.0, 12.0)];
    let certificate = certify(&chain(&off), &chain(&planar(0.4)), &ranges, Budget::default()).unwrap();
    assert_close(&certificate.position_m, 2.0 * (0.01_f64 / 2.0).sin() * 0.4);
}

#[test]
fn parallel_joints_in_another_order_agree_in_orientation() {
    // The same two lengths, the joints exchanged: shoulder and elbow trade their parts.
    let arm = chain(&planar(0.4));
    let [in_order, exchanged] =
        [[0, 1], [1, 0]].map(|drivers| DrivenScrews { chain: arm.clone(), drivers: drivers.to_vec() });
    let ranges = [TURN, (-0.5, 0.5)];
    let certificate = certify_driven(&in_order, &exchanged, &ranges, Budget::default()).unwrap();
    assert_exact(&certificate.orientation_rad, 0.0);
    let apart = |q: [f64; 2]| {
        let tip = |q1: f64, q2: f64| {
            0.6 * Vector3::new(q1.cos(), q1.sin(), 0.0)
                + 0.4 * Vector3::new((q1 + q2).cos(), (q1 + q2).sin(), 0.0)
        };
        (tip(q[0], q[1]) - tip(q[1], q[0])).norm()
    };
    let steps = (-100..=100).flat_map(|i| (-20..=20).map(move |j| (i, j)));
    let sampled =
        steps.map(|(i, j)| apart([f64::from(i) * PI / 100.0, f64::from(j) * 0.025])).fold(0.0, f64::max);
    assert_close(&certificate.position_m, sampled);
}

#[test]
fn a_small_budget_gives_a_wide_bound_that_holds() {
    let off =
        changed(&ur5e_table(), |arm| arm.base_from_dh0 = Isometry3::rotation(Vector3::new(0.01, 0.02, 0.0)));
    let (a, b) = (chain(&off), chain(&ur5e_table()));
    let budget = Budget { corners: 10, ..Budget::default() };
    let position_m = certify(&a, &b, &[TURN; 6], budget).unwrap().position_m;
    assert!(position_m.certified.is_finite() && !position_m.is_within(budget.relative_gap));
    let enough = certify(&a, &b, &[TURN; 6], Budget::default()).unwrap().position_m;
    assert!(enough.attained <= position_m.certified);
}

#[test]
fn wrong_ranges_are_rejected() {
    let (two, six) = (chain(&planar(0.4)), chain(&ur5e_table()));
    let refused = |ranges: &[(f64, f64)]| certify(&two, &two, ranges, Budget::default()).unwrap_err();
    assert_eq!(refused(&[TURN]), KinematicsError::JointCount { expected: 2, found: 1 });
    let unlimited = refused(&[TURN, (f64::NEG_INFINITY, 0.0)]);
    assert!(matches!(unlimited, KinematicsError::JointRange { joint: 1, .. }), "{unlimited}");
    assert!(matches!(refused(&[(0.0, f64::NAN), TURN]), KinematicsError::JointRange { joint: 0, .. }));
    assert!(matches!(refused(&[(1.0, -1.0), TURN]), KinematicsError::JointRange { joint: 0, .. }));
    let unequal = certify(&two, &six, &[TURN; 2], Budget::default()).unwrap_err();
    assert_eq!(unequal, KinematicsError::JointCount { expected: 2, found: 6 });
}

/// At many configurations, none of which exceeds the certificate.
fn assert_holds(a: &ScrewChain, b: &ScrewChain, ranges: &[(f64, f64)]) -> Result<(), TestCaseError> {
    const SAMPLES: u32 = 1000;
    const PRIMES: [f64; 7] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0];
    let budget = Budget { relative_gap: 0.05, corners: 100_000 };
    let Certificate { position_m, orientation_rad } =
        certify(a, b, ranges, budget).expect("as many ranges as joints");
    let apart = |q: &ChainQ| {
        let [a, b] = [a, b].map(|chain| chain.base_from_tip(q).expect("as many positions as joints"));
        (a.distance_m(&b), a.angle_rad(&b))
    };
    prop_assert!(position_m.attained <= position_m.certified);
    prop_assert!(orientation_rad.attained <= orientation_rad.certified);
    for (bracket, is_position) in [(&position_m, true), (&orientation_rad, false)] {
        prop_assert!(bracket.at.iter().zip(ranges).all(|(q, range)| (range.0..=range.1).contains(q)));
        let (distance_m, angle_rad) = apart(&bracket.at.as_slice().into());
        let there = if is_position { distance_m } else { angle_rad };
        prop_assert!((there.min(bracket.certified) - bracket.attained).abs() <= SAMPLE_ROUNDING);
    }
    for sample in 0..SAMPLES {
        let place = |(range, prime): (&(f64, f64), f64)| {
            range.0 + (range.1 - range.0) * (f64::from(sample) * prime.sqrt()).fract()
        };
        let q: ChainQ = ranges.iter().zip(PRIMES).map(place).collect();
        let (distance_m, angle_rad) = apart(&q);
        prop_assert!(distance_m <= position_m.certified + SAMPLE_ROUNDING);
        prop_assert!(angle_rad <= orientation_rad.certified + SAMPLE_ROUNDING);
    }
    Ok(())
}

fn ranges() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let range = (-PI..PI, 0.0..2.0 * PI).prop_map(|(lower, width)| (lower, lower + width));
    proptest::collection::vec(range, 7)
}

fn any_chain() -> impl Strategy<Value = ScrewChain> {
    let twist = (support::vector(), support::vector(), 0..3).prop_map(|(angular, linear, kind)| match kind {
        0 => Twist { angular: Vector3::zeros(), linear },
        1 => Twist { angular, linear: angular.cross(&linear) },
        _ => Twist { angular, linear },
    });
    (proptest::collection::vec(twist, 3), support::isometry()).prop_map(|(twists_in_base, home)| ScrewChain {
        twists_in_base,
        base_from_tip_at_zero: Pose::from(home),
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..support::cases() })]

    #[test]
    fn no_configuration_of_a_changed_table_exceeds_the_certificate(
        figures in support::table_figures(),
        changes in proptest::collection::vec(support::dh_figures(), 7),
        exponent in -12.0..0.0,
        ranges in ranges(),
    ) {
        let scale = 10_f64.powf(exponent);
        let other = changed(&figures, |other| {
            for (row, [a, alpha, d, theta]) in other.rows.iter_mut().zip(changes) {
                row.a_m += scale * a;
                row.alpha_rad += scale * alpha;
                row.d_m += scale * d;
                row.theta_rad += scale * theta;
            }
        });
        assert_holds(&chain(&figures), &chain(&other), &ranges[..figures.rows.len()])?;
    }

    #[test]
    fn no_configuration_of_unlike_chains_exceeds_the_certificate(
        a in any_chain(), b in any_chain(), ranges in ranges(),
    ) {
        assert_holds(&a, &b, &ranges[..3])?;
    }

    #[test]
    fn no_configuration_of_a_moved_chain_with_another_ratio_exceeds_the_certificate(
        a in any_chain(), base in support::isometry(), tool in support::isometry(),
        (joint, ratio) in (0_usize..3, -20.0..20.0), ranges in ranges(),
    ) {
        let base = Pose::from(base);
        let mut b = ScrewChain {
            twists_in_base: a.twists_in_base.iter().map(|twist| twist.transformed_by(&base)).collect(),
            base_from_tip_at_zero: base * a.base_from_tip_at_zero * Pose::from(tool),
        };
        let Twist { angular, linear } = b.twists_in_base[joint];
        b.twists_in_base[joint] = Twist { angular: angular * ratio, linear: linear * ratio };
        assert_holds(&a, &b, &ranges[..3])?;
    }

    #[test]
    fn moving_both_bases_moves_nothing(figures in support::table_figures(), base in support::isometry()) {
        let other = changed(&figures, |other| other.rows[0].alpha_rad += 0.01);
        let moved = |figures: &TableFigures| changed(figures, |it| it.base_from_dh0 = base * it.base_from_dh0);
        let ranges = vec![(-1.0, 1.0); figures.rows.len()];
        let certified = |a: &TableFigures, b: &TableFigures| {
            certify(&chain(a), &chain(b), &ranges, Budget { relative_gap: 0.05, corners: 100_000 }).unwrap()
        };
        let (here, there) = (certified(&figures, &other), certified(&moved(&figures), &moved(&other)));
        prop_assert!(here.position_m.attained <= there.position_m.certified + SAMPLE_ROUNDING);
        prop_assert!(there.position_m.attained <= here.position_m.certified + SAMPLE_ROUNDING);
    }
}
