//! What every parameter of a table and every number of a chain of screws does to the tip.

use congruent_description::{ChainQ, DhConvention, DhTable, Robot, RobotQ};
use congruent_kinematics::{
    DhChain, DhDerivatives, DhRowTwists, KinematicsError, Pose, ScrewChain, ScrewDerivatives, SerialChain,
    Twist,
};
use nalgebra::{Isometry3, Vector3};
use num_dual::Dual64;
use proptest::prelude::*;

use crate::{
    apart,
    duals::{self, DualPose, Table, space_twist},
    numbers, robots,
    support::{self, RowFigures, TableFigures, within},
};

/// Rounding, ours and the dual numbers', over up to seven rows within 10 m; worst seen 9.3e-15.
const BY_TABLE: f64 = 1e-13;
/// Rounding, ours and that of the dual numbers' power series, with screws of up to 3 rad and 5 m for each
/// joint; worst seen 1.5e-14.
const BY_SCREWS: f64 = 1e-13;
/// Golden digits: half a unit of the twelfth.
const PRINTED: f64 = 5.01e-13;

fn real(number: f64) -> Dual64 {
    Dual64::from_re(number)
}

/// The table with no parameter changing.
fn still(table: &DhTable) -> Table<Dual64> {
    let nothing = [real(0.0); 6];
    Table {
        convention: table.convention,
        base: (nothing, table.base_from_dh0),
        rows: table
            .rows
            .iter()
            .map(|row| [row.a_m, row.alpha_rad, row.d_m, row.theta_rad].map(real))
            .collect(),
        tip: (nothing, table.dhn_from_tip),
        joints: table.rows.iter().map(|row| (row.kind, row.sign)).collect(),
    }
}

/// In the order of [`Table::rows`].
fn four(by: &DhRowTwists) -> [Twist; 4] {
    [by.a, by.alpha, by.d, by.theta]
}

/// Holds all derivatives of a table against dual numbers; `q` is the robot's.
#[track_caller]
fn hold_table(table: &DhTable, robot: &Robot, q: &RobotQ) {
    let chain = DhChain::new(table, robot);
    let of_rows = q.chain_positions(chain.coordinates());
    let mut found = DhDerivatives::default();
    chain.derivatives_into(q, &mut found).unwrap();
    assert_eq!(found.base_from_tip, chain.base_from_tip(q).unwrap());
    let still = still(table);
    let near = |found: &Twist, changing: &Table<Dual64>| {
        let expected = space_twist(&changing.base_from_tip(&of_rows));
        assert!(within(apart(found, &expected), BY_TABLE), "{found:?} {expected:?}");
    };
    assert_eq!(found.by_rows.len(), table.rows.len());
    for (row, by) in found.by_rows.iter().enumerate() {
        for (parameter, found) in four(by).iter().enumerate() {
            let mut changing = still.clone();
            changing.rows[row][parameter].eps = 1.0;
            near(found, &changing);
        }
    }
    for component in 0..6 {
        let mut changing = still.clone();
        changing.base.0[component].eps = 1.0;
        near(&found.by_base_from_dh0[component], &changing);
        let mut changing = still.clone();
        changing.tip.0[component].eps = 1.0;
        near(&found.by_dhn_from_tip[component], &changing);
    }
}

/// Holds all derivatives of a chain of screws against dual numbers.
#[track_caller]
fn hold_screws(chain: &ScrewChain, q: &ChainQ) {
    let mut found = ScrewDerivatives::default();
    chain.derivatives_into(q, &mut found).unwrap();
    assert_eq!(found.base_from_tip, chain.base_from_tip(q).unwrap());
    let six = |twist: &Twist| {
        let (w, v) = (twist.angular, twist.linear);
        [w.x, w.y, w.z, v.x, v.y, v.z].map(real)
    };
    let still: Vec<[Dual64; 6]> = chain.twists_in_base.iter().map(six).collect();
    let pose = |screws: &[[Dual64; 6]], of_home: [Dual64; 6]| {
        let step = |pose: DualPose<Dual64>, (screw, &q): (&[Dual64; 6], &f64)| {
            pose * duals::exponential(screw.map(|component| component * q))
        };
        let moved = screws.iter().zip(q).fold(DualPose::identity(), step);
        let home = chain.base_from_tip_at_zero.to_isometry();
        space_twist(&(moved * duals::exponential(of_home) * duals::constant(&home)))
    };
    let near = |found: &Twist, expected: &Twist| {
        assert!(within(apart(found, expected), BY_SCREWS), "{found:?} {expected:?}");
    };
    let nothing = [real(0.0); 6];
    assert_eq!(found.by_screws.len(), q.len());
    for component in 0..6 {
        for (joint, by) in found.by_screws.iter().enumerate() {
            let mut changing = still.clone();
            changing[joint][component].eps = 1.0;
            near(&by[component], &pose(&changing, nothing));
        }
        let mut changing = nothing;
        changing[component].eps = 1.0;
        near(&found.by_home[component], &pose(&still, changing));
    }
}

#[test]
fn case_12_derivatives_by_the_tables_of_real_robots() {
    let mut tables = 0;
    for (seed, description) in (0..).zip(robots()) {
        let Some(table) = &description.dh else { continue };
        let n = description.robot.dof();
        for q in [RobotQ::zeros(n), numbers(n, seed).into()] {
            hold_table(table, &description.robot, &q);
        }
        tables += 1;
    }
    assert!(tables >= 7, "{tables} tables");
}

#[test]
fn case_12_derivatives_by_the_screws_of_real_robots() {
    for (seed, description) in (0..).zip(robots()) {
        let (robot, base, tip) = (&description.robot, description.base, description.tip);
        let coordinates = SerialChain::from_urdf(robot, base, tip).coordinates().to_vec();
        let chain = ScrewChain::from_urdf(robot, base, tip, &coordinates).unwrap();
        let n = coordinates.len();
        for q in [ChainQ::zeros(n), numbers(n, seed).into()] {
            hold_screws(&chain, &q);
        }
    }
}

/// The lecture's 3R arm at 20, -30, 40 degrees. By hand, with the arm's plane turned by `q1`:
/// `a` lengthens along the link, `d` along the hinge; `alpha_1` tilts the plane about the first link's x.
#[test]
fn case_12_derivatives_of_the_reference_arm_by_its_dh_figures() {
    let rows = [
        RowFigures::revolute(0.30, 90.0, 0.20),
        RowFigures::revolute(0.40, 0.0, 0.0),
        RowFigures::revolute(0.20, 0.0, 0.0),
    ];
    let figures = TableFigures::new(DhConvention::Standard, &rows);
    let robot = figures.robot();
    let table = figures.table(&robot);
    let q = RobotQ::from([20_f64, -30.0, 40.0].map(f64::to_radians));
    hold_table(&table, &robot, &q);
    let mut derivatives = DhDerivatives::default();
    DhChain::new(&table, &robot).derivatives_into(&q, &mut derivatives).unwrap();
    let tip = derivatives.base_from_tip.translation;
    let moved = |by: Twist, printed: [f64; 3]| {
        let velocity = by.linear + by.angular.cross(&tip);
        assert!(within((velocity - Vector3::from(printed)).amax(), PRINTED), "{velocity} for {printed:?}");
    };
    let [first, second, third] = derivatives.by_rows[..] else { panic!("three rows") };
    // (cos 20, sin 20, 0); (cos 20 cos 30, sin 20 cos 30, -1/2); (cos 20 cos 10, sin 20 cos 10, sin 10).
    moved(first.a, [0.939_692_620_786, 0.342_020_143_326, 0.0]);
    moved(second.a, [0.813_797_681_349, 0.296_198_132_726, -0.5]);
    moved(third.a, [0.925_416_578_398, 0.336_824_088_833, 0.173_648_177_667]);
    moved(first.d, [0.0, 0.0, 1.0]);
    // (sin 20, -cos 20, 0): the hinge of the second joint.
    moved(second.d, [0.342_020_143_326, -0.939_692_620_786, 0.0]);
    // The tip is 0.2 - 0.034729635533 below the first link: times the same direction, downwards.
    moved(first.alpha, [-0.056_525_793_742, 0.155_303_341_924, 0.0]);
    // The last x axis goes through the tip.
    moved(third.alpha, [0.0; 3]);
    // The first joint: z cross the tip.
    moved(first.theta, [-0.288_450_113_855, 0.792_510_174_455, 0.0]);
}

/// Screws of any pitch and length, a tenth of them too short to see, joints at zero among them.
fn screws() -> impl Strategy<Value = (ScrewChain, ChainQ)> {
    let length = prop_oneof![9 => 0.0..1.5, 1 => Just(0.0), 1 => (-30.0..-1.0).prop_map(|exponent| 10_f64.powf(exponent))];
    let position = prop_oneof![5 => -2.0..2.0, 1 => Just(0.0)];
    let joint = (support::unit_vector(), length, support::vector(), position);
    (proptest::collection::vec(joint, 1..=7), support::isometry()).prop_map(|(joints, home)| {
        let twist = |&(axis, length, linear, _): &(nalgebra::Unit<Vector3<f64>>, f64, _, _)| Twist {
            angular: axis.into_inner() * length,
            linear,
        };
        let chain = ScrewChain {
            twists_in_base: joints.iter().map(twist).collect(),
            base_from_tip_at_zero: Pose::from(home),
        };
        (chain, joints.iter().map(|joint| joint.3).collect())
    })
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn derivatives_by_random_tables(figures in support::table_figures(), q in support::positions()) {
        let robot = figures.robot();
        hold_table(&figures.table(&robot), &robot, &q.of_robot(&robot));
    }

    #[test]
    fn derivatives_by_random_screws((chain, q) in screws()) {
        hold_screws(&chain, &q);
    }
}

#[test]
fn wrong_lengths_are_refused() {
    let refused = Err(KinematicsError::JointCount { expected: 0, found: 1 });
    let chain = ScrewChain { twists_in_base: Vec::new(), base_from_tip_at_zero: Pose::identity() };
    assert_eq!(chain.derivatives_into(&ChainQ::zeros(1), &mut ScrewDerivatives::default()), refused);
    let figures = TableFigures {
        base_from_dh0: Isometry3::identity(),
        ..TableFigures::new(DhConvention::Modified, &[])
    };
    let robot = figures.robot();
    let chain = DhChain::new(&figures.table(&robot), &robot);
    assert_eq!(chain.derivatives_into(&RobotQ::zeros(1), &mut DhDerivatives::default()), refused);
}
