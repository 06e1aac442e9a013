//! Tables derived from axes in every position, and conversions: each is held against what it came from.

#![expect(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "helpers of tests panic; values are tidied, so they are exact"
)]

#[path = "support/mod.rs"]
mod support;

use std::f64::consts::{FRAC_PI_2, PI};

use congruent_description::{ChainQ, DhConvention, DhRowKind};
use congruent_kinematics::{
    AxisRelation, Choice, DeriveError, DhDerivation, ModifiedDh, NotADhTransform, Pose, Proof, ROUNDED_M,
    ROUNDED_RAD, Screw, ScrewChain, SerialDh, StandardDh, Twist, derive_dh, without_rounding,
};
use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use support::{RowFigures, TableFigures, within};

/// What every derived table is held to: rad and m.
const ACCURACY: f64 = 1e-12;
const BOTH: [DhConvention; 2] = [DhConvention::Standard, DhConvention::Modified];

/// Rounding for each metre that a common normal is away: a few eps; worst seen 1.3e-15.
const FAR_NORMAL: f64 = 5e-15;

#[track_caller]
fn prove(dh: &SerialDh, chain: &ScrewChain) {
    let n = chain.joint_count();
    let configurations: Vec<ChainQ> = [0.0, 0.7, -2.1]
        .into_iter()
        .map(|shift| (0..n).map(|joint| shift + 0.3 * f64::from(u8::try_from(joint).unwrap())).collect())
        .collect();
    let found = &mut |q: &ChainQ| dh.base_from_tip(q).unwrap();
    let proof = Proof::compare(n, &configurations, found, &mut |q| chain.base_from_tip(q).unwrap());
    // Axes that a random draw makes nearly parallel have their normal far away, which costs accuracy.
    let furthest_m = dh.rows.iter().map(|row| row.d_m.abs()).fold(0.0, f64::max);
    let bound = ACCURACY.max(FAR_NORMAL * furthest_m);
    assert!(within(proof.worst() / bound, 1.0), "{proof:?}\n{dh:?}\n{chain:?}");
}

#[track_caller]
fn derived(chain: &ScrewChain) -> DhDerivation {
    for convention in BOTH {
        prove(&derive_dh(chain, convention, ACCURACY).unwrap().dh, chain);
    }
    derive_dh(chain, DhConvention::Standard, ACCURACY).unwrap()
}

fn turn(axis: [f64; 3], point: [f64; 3]) -> Twist {
    Screw::revolute(Unit::new_normalize(Vector3::from(axis)), &Point3::from(point)).twist()
}

fn slide(axis: [f64; 3]) -> Twist {
    Screw::prismatic(Unit::new_normalize(Vector3::from(axis))).twist()
}

/// A tip that is no multiple of anything.
fn crooked_tip() -> Pose {
    Isometry3::new(Vector3::new(0.31, -0.22, 0.57), Vector3::new(0.4, 1.1, -0.8)).into()
}

fn chain(twists_in_base: &[Twist]) -> ScrewChain {
    ScrewChain { twists_in_base: twists_in_base.to_vec(), base_from_tip_at_zero: crooked_tip() }
}

/// Two axes: how they lie, and the parameters between them.
#[track_caller]
fn assert_pair(second: Twist, relation: AxisRelation, [a_m, alpha_rad]: [f64; 2]) {
    let first = turn([0., 0., 1.], [0.; 3]);
    for twists in [vec![first, second], vec![second, first], vec![first, second, first, second]] {
        let derivation = derived(&chain(&twists));
        assert!(derivation.pairs.iter().all(|pair| pair.relation == relation), "{derivation:?}");
        let row = derivation.dh.rows[0];
        assert!(
            within((row.a_m.abs() - a_m).abs(), ACCURACY)
                && within((row.alpha_rad.abs() - alpha_rad).abs(), ACCURACY)
        );
    }
}

#[test]
fn case_18_skew_axes() {
    assert_pair(turn([0., -1., 1.], [0.3, 0.5, 0.]), AxisRelation::Skew, [0.3, PI / 4.0]);
    assert_pair(turn([0., 1., 0.], [-0.3, 0.5, 0.2]), AxisRelation::Skew, [0.3, FRAC_PI_2]);
}

#[test]
fn case_18_intersecting_axes() {
    assert_pair(turn([0., 1., 0.], [0., 7.0, 0.2]), AxisRelation::Intersecting, [0., FRAC_PI_2]);
    assert_pair(turn([1., 0., 1.], [0., 0., -0.4]), AxisRelation::Intersecting, [0., PI / 4.0]);
}

#[test]
fn case_18_parallel_axes() {
    assert_pair(turn([0., 0., 1.], [0.3, -0.4, 9.0]), AxisRelation::Parallel, [0.5, 0.]);
    assert_pair(turn([0., 0., -1.], [0.3, -0.4, 9.0]), AxisRelation::AntiParallel, [0.5, PI]);
}

#[test]
fn case_18_coincident_axes() {
    assert_pair(turn([0., 0., 1.], [0., 0., 3.0]), AxisRelation::Coincident, [0., 0.]);
    assert_pair(turn([0., 0., -1.], [0., 0., 3.0]), AxisRelation::Coincident, [0., PI]);
}

#[test]
fn case_18_free_choices_are_reported() {
    let twists = [turn([0., 0., 1.], [0.; 3]), turn([0., 0., 1.], [0.4, 0., 0.]), slide([0., 0., -1.])];
    let choices: Vec<(usize, Choice)> =
        derived(&chain(&twists)).choices.into_iter().map(|free| (free.joint, free.choice)).collect();
    // The quill's line goes through the tip's origin, aside of the axis before.
    let expected = [
        (0, Choice::FirstFrame),
        (0, Choice::ParallelOrigin),
        (1, Choice::ParallelOrigin),
        (2, Choice::PrismaticLine),
        (2, Choice::LastFrame),
    ];
    assert_eq!(choices, expected);
}

#[test]
fn case_17_a_transform_of_a_row_is_one() {
    let row = StandardDh { a_m: 0.25, alpha_rad: FRAC_PI_2, d_m: 0.1, theta_rad: PI / 6.0 };
    let found = StandardDh::from_transform(&row.transform()).unwrap();
    let difference = [
        found.a_m - row.a_m,
        found.alpha_rad - row.alpha_rad,
        found.d_m - row.d_m,
        found.theta_rad - row.theta_rad,
    ];
    assert!(difference.into_iter().all(|value| within(value.abs(), f64::EPSILON)));
    // The same matrix is no row of the other convention: x0 is 30 degrees off z1's perpendicular.
    let refused = ModifiedDh::from_transform(&row.transform()).unwrap_err();
    assert!(within((refused.off_perpendicular_rad - PI / 6.0).abs(), ACCURACY), "{refused}");
}

#[track_caller]
fn assert_refused(refused: &NotADhTransform, [angle_rad, distance_m]: [f64; 2], message: &str) {
    assert!(within((refused.off_perpendicular_rad - angle_rad).abs(), ACCURACY), "{refused:?}");
    assert!(within((refused.off_meeting_m - distance_m).abs(), ACCURACY), "{refused:?}");
    assert_eq!(refused.to_string(), message);
}

#[test]
fn case_17_a_refusal_says_which_condition_fails_and_by_how_much() {
    let row = StandardDh { a_m: 0.25, alpha_rad: 0.4, d_m: 0.1, theta_rad: 0.9 }.transform();
    let shifted = |y| row * Pose::from(Isometry3::translation(0., y, 0.));
    // 3 mm along y1, of which cos(alpha) is across x1 and z0.
    let across = 0.003 * 0.4_f64.cos();
    assert_refused(
        &StandardDh::from_transform(&shifted(0.003)).unwrap_err(),
        [0.0, across],
        &format!(
            "not a standard DH transform: x1 passes z0 at a distance of {across:.9} m instead of meeting it"
        ),
    );
    let turned = |angle| row * Pose::from(Isometry3::rotation(Vector3::y() * angle));
    let refused = StandardDh::from_transform(&turned(0.02)).unwrap_err();
    assert!(refused.is_oblique() && refused.is_apart(), "{refused}");
    let tilt = Pose::from(Isometry3::rotation(Vector3::y() * 0.02));
    assert_refused(
        &StandardDh::from_transform(&tilt).unwrap_err(),
        [0.02, 0.0],
        "not a standard DH transform: x1 is 1.145915590 deg off the perpendicular to z0",
    );
    assert_refused(
        &ModifiedDh::from_transform(&tilt).unwrap_err(),
        [0.02, 0.0],
        "not a modified DH transform: x0 is 1.145915590 deg off the perpendicular to z1",
    );
    let along_z = Pose::from(Isometry3::new(Vector3::new(0.3, 0.4, 1.0), Vector3::y() * -FRAC_PI_2));
    assert_refused(
        &StandardDh::from_transform(&along_z).unwrap_err(),
        [FRAC_PI_2, 0.5],
        "not a standard DH transform: x1 is 90.000000000 deg off the perpendicular to z0, and x1 passes z0 at a \
         distance of 0.500000000 m instead of meeting it",
    );
}

#[test]
fn a_vendors_arm_gives_the_vendors_figures() {
    let lengths = [
        (0.0, 90.0, 0.1625),
        (0.425, 0.0, 0.0),
        (0.3922, 0.0, 0.0),
        (0.0, 90.0, 0.1333),
        (0.0, -90.0, 0.0997),
        (0.0, 0.0, 0.0996),
    ];
    let rows = lengths.map(|(a_m, alpha_deg, d_m)| RowFigures::revolute(a_m, alpha_deg, d_m));
    let figures = TableFigures::new(DhConvention::Standard, &rows);
    let found = derived(&chain_of(&figures)).dh;
    assert_eq!(found.base_from_dh0, Pose::identity());
    assert_eq!(found.dhn_from_tip, Pose::identity());
    for (row, (a_m, alpha_deg, d_m)) in found.rows.iter().zip(lengths) {
        assert_eq!(
            [row.a_m, row.alpha_rad, row.d_m, row.theta_rad],
            [a_m, f64::to_radians(alpha_deg), d_m, 0.0]
        );
    }
}

fn chain_of(figures: &TableFigures) -> ScrewChain {
    let robot = figures.robot();
    SerialDh::from_table(&figures.table(&robot)).screw_chain()
}

#[test]
fn axes_that_ten_digits_leave_nearly_perpendicular_lose_nothing() {
    let written = FRAC_PI_2 + 2.05e-10; // 1.570796327
    let turned = |q: UnitQuaternion<f64>| (q * Vector3::z_axis()).into_inner().into();
    let tilt = UnitQuaternion::from_euler_angles(written, 0., 0.);
    let back = tilt * UnitQuaternion::from_euler_angles(-FRAC_PI_2 - 3.7e-6, 0., 0.);
    derived(&chain(&[
        turn([0., 0., 1.], [0.; 3]),
        turn(turned(tilt), [0., 0.138, 0.1]),
        turn(turned(tilt), [0., -0.131, 0.5]),
        turn(turned(back), [0.1, 0.127, 0.5]),
    ]));
}

#[test]
fn a_coarser_accuracy_simplifies_and_shows_what_it_costs() {
    let off = 4e-10;
    let chain = chain(&[turn([0., 0., 1.], [0.; 3]), turn([0., off, 1.], [0.3, 0.4, 0.1])]);
    let exact = derive_dh(&chain, DhConvention::Standard, ACCURACY).unwrap();
    assert!(exact.pairs[0].normal_at_m.abs() > 1e8, "{exact:?}");
    let coarse = derive_dh(&chain, DhConvention::Standard, 1e-8).unwrap();
    assert_eq!(coarse.pairs[0].relation, AxisRelation::Parallel);
    let found = &mut |q: &ChainQ| coarse.dh.base_from_tip(q).unwrap();
    let proof = Proof::compare(2, &[], found, &mut |q| chain.base_from_tip(q).unwrap());
    assert!(proof.worst() > 1e-10 && proof.worst() < 1e-8, "{proof:?}");
}

/// The axes are 0.3 m and 0.4 m apart and turned by the error of 1.5707 for a quarter turn.
#[test]
fn axes_that_rounding_makes_nearly_parallel_are_parallel_through_their_origins() {
    let off: f64 = 9.632_679_489_66e-5;
    let origin = Vector3::new(0.3, 0.4, 0.1);
    for (sense, relation) in [(1.0, AxisRelation::Parallel), (-1.0, AxisRelation::AntiParallel)] {
        let second = turn([0., off.sin() * sense, off.cos() * sense], origin.into());
        let written = chain(&[turn([0., 0., 1.], [0.; 3]), second]);
        let (rounded_out, pairs) = without_rounding(&written, &[Vector3::zeros(), origin], ACCURACY).unwrap();
        let [pair] = pairs[..] else { panic!("{pairs:?}") };
        assert_eq!((pair.joint, pair.relation, pair.distance_m), (0, relation, 0.0));
        assert!(within(pair.angle_rad - off.sin(), 1e-15), "{pair:?}");
        let plain = turn([0., 0., sense], origin.into());
        assert_eq!(rounded_out.twists_in_base[1].angular, plain.angular);
        assert!(
            within((rounded_out.twists_in_base[1].linear - plain.linear).norm(), 1e-15),
            "{rounded_out:?}"
        );
        let row = derived(&rounded_out).dh.rows[0];
        assert!(within(row.a_m - 0.5, 1e-15) && row.d_m == 0.0, "{row:?}");
        // Two of them and more are a real angle.
        let real =
            chain(&[turn([0., 0., 1.], [0.; 3]), turn([0., 2.1 * ROUNDED_RAD / 2.0, 1.], origin.into())]);
        assert_eq!(without_rounding(&real, &[], ACCURACY).unwrap(), (real, Vec::new()));
    }
}

#[test]
fn axes_that_rounding_moves_apart_meet_or_are_one_line() {
    let first = turn([0., 0., 1.], [0.; 3]);
    let rounded_out = |second: Twist| {
        let (rounded_out, pairs) = without_rounding(&chain(&[first, second]), &[], ACCURACY).unwrap();
        (rounded_out.twists_in_base[1], pairs.first().map(|pair| (pair.relation, pair.distance_m)))
    };
    let (across, along) = (turn([0., 1., 0.], [2e-5, 0., 0.3]), turn([0., 0., 1.], [0., 3e-5, 0.3]));
    assert_eq!(
        rounded_out(across),
        (turn([0., 1., 0.], [0., 0., 0.3]), Some((AxisRelation::Intersecting, 2e-5)))
    );
    assert_eq!(rounded_out(along), (turn([0., 0., 1.], [0.; 3]), Some((AxisRelation::Coincident, 3e-5))));
    for apart in [2.0 * ROUNDED_M, 1e-12] {
        let as_it_is = turn([0., 1., 0.], [apart, 0., 0.3]);
        assert_eq!(rounded_out(as_it_is), (as_it_is, None));
    }
    let (quill, pair) = rounded_out(slide([1e-5, 0., 1.]));
    assert_eq!((quill, pair.unwrap().0), (slide([0., 0., 1.]), AxisRelation::Parallel));
}

#[test]
fn joints_that_fit_no_row_are_named() {
    let derive = |twists: &[Twist]| derive_dh(&chain(twists), DhConvention::Modified, ACCURACY).unwrap_err();
    let first = turn([0., 0., 1.], [0.; 3]);
    let scaled = |by: f64| Twist { angular: first.angular * by, linear: first.linear * by };
    assert_eq!(derive(&[]), DeriveError::NoJoint);
    assert_eq!(derive(&[first, scaled(0.0)]), DeriveError::Motionless { joint: 1 });
    assert_eq!(derive(&[first, scaled(2.0)]), DeriveError::Ratio { joint: 1, ratio: 2.0 });
    let helical = Twist { linear: Vector3::z() * 0.01, ..first };
    assert_eq!(derive(&[helical]), DeriveError::Helical { joint: 0, pitch_m_per_rad: 0.01 });
    assert_eq!(derive(&[helical]).joint(), Some(0));
}

/// Parameters of which most are 0 or a quarter turn: every degenerate position of axes comes up.
fn square_figures() -> impl Strategy<Value = TableFigures> {
    let angle = || prop_oneof![3 => Just(0.0), 1 => Just(FRAC_PI_2), 1 => Just(-FRAC_PI_2), 1 => Just(PI), 1 => -PI..PI];
    let length = || prop_oneof![2 => Just(0.0), 1 => -1.0..1.0];
    let row = (length(), angle(), length(), angle(), any::<[bool; 2]>()).prop_map(
        |(a_m, alpha_rad, d_m, theta_rad, [turns, backwards])| RowFigures {
            kind: if turns { DhRowKind::Revolute } else { DhRowKind::Prismatic },
            a_m,
            alpha_rad,
            d_m,
            theta_rad,
            sign: if backwards { -1.0 } else { 1.0 },
        },
    );
    (proptest::collection::vec(row, 1..=7), support::isometry(), any::<bool>()).prop_map(
        |(rows, aside, plain)| {
            let aside = if plain { Isometry3::identity() } else { aside };
            TableFigures {
                base_from_dh0: aside,
                dhn_from_tip: aside.inverse(),
                ..TableFigures::new(DhConvention::Standard, &rows)
            }
        },
    )
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn any_chain_gives_tables_that_are_the_same_robot(figures in support::table_figures()) {
        derived(&chain_of(&figures));
    }

    #[test]
    fn square_chains_too(figures in square_figures()) {
        derived(&chain_of(&figures));
    }

    #[test]
    fn case_09_both_conventions_hold_the_same_robot(figures in support::table_figures()) {
        let robot = figures.robot();
        let declared = SerialDh::from_table(&figures.table(&robot));
        for convention in BOTH {
            let other = declared.to_convention(convention);
            prove(&other, &declared.screw_chain());
            prove(&other.to_convention(declared.convention), &declared.screw_chain());
            let signs = |dh: &SerialDh| dh.rows.iter().map(|row| row.sign).collect::<Vec<_>>();
            prop_assert_eq!(signs(&other), signs(&declared));
        }
    }

    #[test]
    fn case_08_a_tables_screws_are_those_of_its_robot(figures in support::table_figures()) {
        let robot = figures.robot();
        let coordinates: Vec<usize> = (0..robot.dof()).collect();
        let tip = robot.find_link("tip").unwrap();
        let by_urdf = ScrewChain::from_urdf(&robot, robot.root(), tip, &coordinates).unwrap();
        prove(&SerialDh::from_table(&figures.table(&robot)), &by_urdf);
        let by_table = chain_of(&figures);
        prove(&derive_dh(&by_urdf, figures.convention, ACCURACY).unwrap().dh, &by_table);
    }
}
