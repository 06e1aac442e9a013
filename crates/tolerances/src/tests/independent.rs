//! Against numbers of numpy, and against tables and origins that are changed themselves.

use congruent_description::{DhTable, RobotDescription, RobotQ, RobotQList};
use congruent_kinematics::{DhChain, Pose, Uniform, UrdfTree};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::{drawn, of_rows, robot, robot_q, typical};
use crate::{
    error_chain::{ErrorMotions, ToolError},
    first_order::ScaledColumns,
    monte_carlo::{Draws, monte_carlo},
    norm_quantile::NormDistribution,
    parameters::{ToleratedChain, declared},
};

/// Where the constants below are from: numpy 2.4.6, products of 4x4 matrices of the six rows of robots/ur5e/robot.toml (base turned by
/// 180 deg about z, tool 50 mm along z), tolerances 0.05 mm of a and d and 0.02 deg of alpha and theta, uniform. The Jacobian is by
/// central differences with h = 1e-6, `C = J S J'`; the quantiles are those of 20,000,000 draws of a normal vector with that
/// covariance; Monte Carlo has 200,000 draws of all 24 errors; the exact error is at errors of `linspace(-1, 1, 24)` times
/// 50 tolerances, in the order theta, d, a, alpha of each row.
const Q: [f64; 6] = [0.3, -1.2, 1.5, -0.4, 0.8, 0.2];
const RMS_M: f64 = 0.000_287_630_940_353_359_45;
const RMS_RAD: f64 = 0.000_698_131_701_779_979_2;
const QUANTILES_M: [f64; 2] = [0.000_484_29, 0.000_669_54];
const MONTE_CARLO_M: [f64; 3] = [0.000_288_064_933_688_918_9, 0.000_466_92, 0.000_599_84];
const EXACT_M: [f64; 3] = [0.006_078_624_153_945_666_5, -0.007_481_206_298_464_493, 0.008_529_731_804_810_87];
const EXACT_RAD: f64 = 0.021_114_606_927_036_5;
/// The largest of 200 local searches over the 2^24 ends of the tolerances, each with both signs.
const WORST_M: f64 = 0.001_170_770_521_972_1;

/// Rounding of a dozen products within 2 m. Kind: rounding; worst seen 2e-15, x5.
const ROUNDING_M: f64 = 1e-14;
/// Central differences of numpy, h = 1e-6: h^2/6 and 1e-16/h of lengths below 1 m, relative. Worst seen 3e-10, x10.
const DIFFERENCE: f64 = 3e-9;
/// Quantiles of 2e7 draws: 0.01 % of their standard error at 99.7 %, of five digits. x3.
const DRAWN: f64 = 1e-3;

fn ur5e() -> (RobotDescription, ToleratedChain) {
    let description = robot("robots/ur5e");
    let tolerated = declared(&description, &of_rows()).unwrap();
    (description, tolerated)
}

#[test]
fn numpy_has_the_same_covariance_quantiles_and_exact_error() {
    let (description, tolerated) = ur5e();
    let q = robot_q(&description, &Q);
    let alone = RobotQList::from(&q);
    let columns = ScaledColumns::new(&tolerated, &alone);
    let found = columns.errors(&tolerated, &NormDistribution::new());
    assert!((found.rms_m / RMS_M - 1.0).abs() < DIFFERENCE, "{}", found.rms_m);
    assert!((found.rms_rad / RMS_RAD - 1.0).abs() < DIFFERENCE, "{}", found.rms_rad);
    assert!((found.p95_m / QUANTILES_M[0] - 1.0).abs() < DRAWN, "{}", found.p95_m);
    assert!((found.p997_m / QUANTILES_M[1] - 1.0).abs() < DRAWN, "{}", found.p997_m);

    let mut at = ErrorMotions::default();
    tolerated.chain.motions_into(&q, &mut at);
    let part = |k: u32| -1.0 + 2.0 * f64::from(k) / 23.0;
    let errors: Vec<f64> =
        (0..24).zip(&tolerated.spread.tolerances).map(|(k, within)| part(k) * within * 50.0).collect();
    let ToolError { shift_in_base, angle_rad } = at.tool_error(&errors);
    assert!((shift_in_base - Vector3::from(EXACT_M)).norm() < ROUNDING_M, "{shift_in_base}");
    assert!((angle_rad - EXACT_RAD).abs() < ROUNDING_M, "{angle_rad}");
}

#[test]
fn numpy_draws_the_same_distribution() {
    /// Three standard errors of the rms and of a 99.7 % quantile of 200,000 draws, twice, relative.
    const CHANCE: [f64; 3] = [3e-3, 4e-3, 12e-3];
    let (description, tolerated) = ur5e();
    let alone = RobotQList::from(&robot_q(&description, &Q));
    let draws = Draws { samples: 200_000, seed: 3 };
    let found = monte_carlo(&tolerated.chain, &tolerated.spread, &alone, draws);
    for ((found, numpy), chance) in
        [found.rms_m, found.p95_m, found.p997_m].into_iter().zip(MONTE_CARLO_M).zip(CHANCE)
    {
        assert!((found / numpy - 1.0).abs() < chance, "{found} {numpy}");
    }
    let [lower, upper] = found.p997_between_m;
    assert!(lower < found.p997_m && found.p997_m < upper, "{found:?}");
}

#[test]
fn the_worst_case_is_the_one_that_numpy_finds() {
    let (description, tolerated) = ur5e();
    let tolerances = &tolerated.spread.tolerances;
    let mut search = crate::worst_case::WorstErrors::new(&tolerated.chain, tolerances);
    let found = search.at(&robot_q(&description, &Q)).position_m;
    assert!((found / WORST_M - 1.0).abs() < 1e-9, "{found}");
}

/// A table with errors in its entries: theta, d, a, alpha of each row.
fn changed(table: &DhTable, errors: &[f64]) -> DhTable {
    let mut changed = table.clone();
    for (row, errors) in changed.rows.iter_mut().zip(errors.chunks(4)) {
        row.theta_rad += errors[0];
        row.d_m += errors[1];
        row.a_m += errors[2];
        row.alpha_rad += errors[3];
    }
    changed
}

/// Large errors of all entries of a table of either convention: the same tool as of the table that is changed itself.
#[test]
fn errors_are_those_of_a_changed_table() {
    for path in ["robots/ur5e", "robots/panda", "robots/cylindrical_rpp"] {
        let description = robot(path);
        let table = description.dh.as_ref().unwrap();
        let tolerated = declared(&description, &of_rows()).unwrap();
        // In the modified convention those of a row are around its joint, and so is their order here.
        let names: Vec<&str> = tolerated.parameters.iter().map(|of| of.name.as_str()).collect();
        assert_eq!(names.len(), 4 * table.rows.len());
        let tool = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        let mut random = Uniform::seeded(4);
        let mut at = ErrorMotions::default();
        for q in drawn(&description, 30) {
            let errors: Vec<f64> = names.iter().map(|_| random.between(-0.1, 0.1)).collect();
            tolerated.chain.motions_into(&q, &mut at);
            let found = at.tool_error(&errors);
            let nominal = DhChain::new(table, &description.robot).base_from_tcp(&q, &tool).unwrap();
            let built = DhChain::new(&changed(table, &errors), &description.robot);
            let built = built.base_from_tcp(&q, &tool).unwrap();
            let shift = built.translation - nominal.translation;
            assert!(
                (found.shift_in_base - shift).norm() < ROUNDING_M,
                "{path}: {}",
                found.shift_in_base - shift
            );
            assert!((found.angle_rad - built.angle_rad(&nominal)).abs() < ROUNDING_M, "{path}");
        }
    }
}

/// Origins of joints that are changed in the robot itself: a shift and three turns about the axes of the joint's frame.
#[test]
fn errors_are_those_of_changed_origins() {
    let description = robot("robots/panda/panda.urdf");
    let (base, tip) = (description.base, description.tip);
    let mut general = typical(&description);
    (general.base, general.tcp) = Default::default();
    (general.general.zero_rad, general.general.zero_m) = (None, None);
    let tolerated = declared(&description, &general).unwrap();
    let joints = description.moving_chain();
    assert_eq!(tolerated.parameters.len(), 6 * joints.len());
    let mut random = Uniform::seeded(5);
    let errors: Vec<f64> = tolerated.parameters.iter().map(|_| random.between(-0.1, 0.1)).collect();
    let names: Vec<&String> = joints.iter().map(|&joint| &description.robot.joint(joint).name).collect();
    let built = description.robot.with_joints(|joint| {
        let Some(at) = names.iter().position(|name| **name == joint.name) else { return };
        let of = &errors[6 * at..6 * at + 6];
        let turn = |axis: Vector3<f64>, angle: f64| UnitQuaternion::from_scaled_axis(axis * angle);
        let turned = turn(Vector3::x(), of[3]) * turn(Vector3::y(), of[4]) * turn(Vector3::z(), of[5]);
        let error = Isometry3::from_parts(Translation3::new(of[0], of[1], of[2]), turned);
        joint.parent_from_joint *= error;
    });
    let pose = |robot: &congruent_description::Robot, q: &RobotQ| {
        let tree = UrdfTree::new(robot);
        tree.root_from_link(q, base).unwrap().inverse() * tree.root_from_link(q, tip).unwrap()
    };
    let mut at = ErrorMotions::default();
    for q in drawn(&description, 30) {
        tolerated.chain.motions_into(&q, &mut at);
        let shift = pose(&built, &q).translation - pose(&description.robot, &q).translation;
        let found = at.tool_error(&errors).shift_in_base;
        assert!((found - shift).norm() < ROUNDING_M, "{}", found - shift);
    }
}

/// Columns against differences over both sides of the exact error, of all kinds of parameters.
#[test]
fn columns_are_derivatives() {
    /// h = 1e-6: h^2/6 and 1e-16/h of a reach of 2 m, m per rad. Worst seen 6e-10, x3.
    const CENTRAL: f64 = 2e-9;
    for path in ["robots/ur5e", "robots/panda", "robots/ur5e/ur5e.urdf"] {
        let description = robot(path);
        let tolerated = declared(&description, &typical(&description)).unwrap();
        let count = tolerated.parameters.len();
        let (mut at, mut columns) = (ErrorMotions::default(), Vec::new());
        for q in drawn(&description, 5) {
            tolerated.chain.motions_into(&q, &mut at);
            at.columns_into(&vec![1.0; count], &mut columns);
            for (parameter, column) in columns.iter().enumerate() {
                let by = |step: f64| {
                    let mut errors = vec![0.0; count];
                    errors[parameter] = step;
                    at.tool_error(&errors).shift_in_base
                };
                let difference = (by(1e-6) - by(-1e-6)) / 2e-6;
                assert!((column.linear - difference).norm() < CENTRAL, "{path} {parameter}");
            }
        }
    }
}
