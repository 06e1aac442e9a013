//! Inverse kinematics on the robots of `robots/`: reference cases, laws, and a reduced, deterministic
//! form of the benchmark `benches/ik.rs`.

use std::path::Path;

use congruent_description::{ArmQ, RobotDescription, RobotQ, load_robot};
use congruent_kinematics::{
    Arm, ArmJoint, IkMethod, IkOptions, IkSolver, IkTarget, Pose, TargetPart, UrdfTree, rotation_exp,
};
use nalgebra::{Matrix3, Vector3};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

/// Rounding between two chains of one robot, a dozen products within 2 m; worst seen 2e-15.
const ROUNDING: f64 = 1e-13;

fn load(name: &str) -> RobotDescription {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    load_robot(&folder).expect("the robot loads")
}

/// The arm without its tool.
fn arm(description: &RobotDescription) -> Arm {
    Arm::new(&description.robot, description.base, description.tip, Pose::identity()).expect("the arm moves")
}

/// The tip by joint after joint of the description: another path than the solver's.
fn base_from_tip(description: &RobotDescription, arm: &Arm, q: &ArmQ) -> Pose {
    let tree = UrdfTree::new(&description.robot);
    let mut q_robot = RobotQ::zeros(description.robot.dof());
    arm.write_to_robot(q, &mut q_robot);
    description.robot.apply_mimic(&mut q_robot);
    let root_from = |link| tree.root_from_link(&q_robot, link).expect("it is a configuration");
    root_from(description.base).inverse() * root_from(description.tip)
}

fn at(xyz: [f64; 3]) -> IkTarget {
    IkTarget { base_from_tcp: Pose::from_parts(Matrix3::identity(), xyz.into()), part: TargetPart::Position }
}

fn drawn(arm: &Arm, random: &mut ChaCha8Rng) -> ArmQ {
    let mut share = || f64::from(random.next_u32()) / f64::from(u32::MAX);
    let ranges = arm.joints().iter().map(ArmJoint::sampled_range);
    ranges.map(|(lower, upper)| lower + (upper - lower) * share()).collect()
}

const CASE_23_START: [f64; 4] = [1.0, 1.0, 1.5, 1.5];
const CASE_23_TARGET: [f64; 3] = [0.598_401_59, -0.211_911_89, 0.422_449_37];

#[test]
fn case_23_by_pseudo_inverse_and_by_transpose_to_a_position() {
    /// Golden digits: the case prints eight decimals; worst seen 4e-9.
    const PRINTED: f64 = 1e-8;
    let rrr = load("rrr_arm");
    let mut solver = IkSolver::new(arm(&rrr));
    let start = base_from_tip(&rrr, solver.arm(), &CASE_23_START.into());
    assert!((start.translation - Vector3::new(0.606_518_77, -0.217_123_93, 0.484_788_84)).amax() < PRINTED);
    for (method, most_steps) in [(IkMethod::PseudoInverse, 6), (IkMethod::Transpose, 400)] {
        let options = IkOptions { method, ..IkOptions::default() };
        let found = solver.solve(&at(CASE_23_TARGET), &CASE_23_START.into(), &options, || true).unwrap();
        assert!(found.converged && found.limits_held.is_empty(), "{method:?}: {found:?}");
        assert!(found.iterations <= most_steps, "{method:?}: {found:?}");
        let q = found.q.clone();
        let reached = base_from_tip(&rrr, solver.arm(), &q).translation;
        assert!((reached - Vector3::from(CASE_23_TARGET)).norm() <= options.tolerance_m + ROUNDING);
    }
}

/// With orientation: a pose that the four joints can reach, near the position of the case.
#[test]
fn case_23_with_orientation() {
    let rrr = load("rrr_arm");
    let mut solver = IkSolver::new(arm(&rrr));
    let base_from_tcp = base_from_tip(&rrr, solver.arm(), &ArmQ::from([1.02, 1.1, 1.45, 1.6]));
    let target = IkTarget { base_from_tcp, part: TargetPart::Pose };
    for method in [IkMethod::PseudoInverse, IkMethod::Transpose] {
        let options = IkOptions { method, tolerance_m: 1e-7, tolerance_rad: 1e-7, ..IkOptions::default() };
        let found = solver.solve(&target, &CASE_23_START.into(), &options, || true).unwrap();
        assert!(found.converged, "{method:?}: {found:?}");
    }
    // The same position, a quarter turn away: four joints cannot, and the result gives the residual.
    let turned = base_from_tcp.rotation * rotation_exp(&(Vector3::x() * std::f64::consts::FRAC_PI_2));
    let target = IkTarget { base_from_tcp: Pose::from_parts(turned, base_from_tcp.translation), ..target };
    let options = IkOptions { method: IkMethod::PseudoInverse, ..IkOptions::default() };
    let found = solver.solve(&target, &CASE_23_START.into(), &options, || true).unwrap();
    assert!(!found.converged, "{found:?}");
    assert!(found.residual_position_m + found.residual_orientation_rad > 0.1, "{found:?}");
}

#[test]
fn case_24_newton_with_the_matrix_logarithm() {
    let ur5e = load("ur5e");
    let mut solver = IkSolver::new(arm(&ur5e));
    let start = ArmQ::from([0.3, -1.2, 1.5, -1.0, -1.4, 0.2]);
    let near: ArmQ = start.iter().map(|q| q + 0.15).collect();
    let base_from_tcp = base_from_tip(&ur5e, solver.arm(), &near);
    let target = IkTarget { base_from_tcp, part: TargetPart::Pose };
    let options = IkOptions { method: IkMethod::Newton, ..IkOptions::default() };
    let found = solver.solve(&target, &start, &options, || true).unwrap();
    assert!(found.converged && found.iterations <= 6, "quadratic convergence: {found:?}");
    assert!(found.q.iter().zip(&near).all(|(found, expected)| (found - expected).abs() < 1e-7));

    // Three metres away: no convergence, an honest residual, the whole budget spent.
    let away = Pose { translation: Vector3::new(3.0, 0.0, 0.0), ..base_from_tcp };
    let options = IkOptions { max_iterations: 100, ..options };
    let target = IkTarget { base_from_tcp: away, ..target };
    let found = solver.solve(&target, &start, &options, || true).unwrap();
    assert!(!found.converged && found.residual_position_m > 2.0 && found.iterations == 100, "{found:?}");
}

/// The protocol of TRAC-IK with steps in place of the clock: 1000 steps take less than a millisecond.
#[test]
fn reachable_poses_are_reached_from_the_middle_of_the_ranges() {
    const POSES: usize = 300;
    for name in ["ur5e", "panda", "rrr_arm"] {
        let description = load(name);
        let mut solver = IkSolver::new(arm(&description));
        let part = if solver.arm().joints().len() < 6 { TargetPart::Position } else { TargetPart::Pose };
        let middle = solver.arm().middle();
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for pose in 0..POSES {
            let q = drawn(solver.arm(), &mut random);
            let base_from_tcp = base_from_tip(&description, solver.arm(), &q);
            let options = IkOptions {
                tolerance_m: 1e-5,
                tolerance_rad: 1e-5,
                max_iterations: 1000,
                ..IkOptions::default()
            };
            let target = IkTarget { base_from_tcp, part };
            let found = solver.solve(&target, &middle, &options, || true).unwrap();
            assert!(found.converged, "{name}, pose {pose}: {found:?}");
            let (q, left_m) = (found.q.clone(), found.residual_position_m);
            let limits = solver.arm().joints().iter().map(|joint| joint.lower..=joint.upper);
            assert!(limits.zip(&q).all(|(limits, q)| limits.contains(q)), "{name}: {q:?}");
            let reached = base_from_tip(&description, solver.arm(), &q);
            assert!((reached.distance_m(&base_from_tcp) - left_m).abs() < ROUNDING, "{name}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_and_a_stop_is_obeyed() {
    let panda = load("panda");
    let mut solver = IkSolver::new(arm(&panda));
    let middle = solver.arm().middle();
    let away = at([2.0, 0.0, 0.3]);
    let solve = |solver: &mut IkSolver, seed| {
        let options = IkOptions { seed, max_iterations: 500, ..IkOptions::default() };
        solver.solve(&away, &middle, &options, || true).unwrap().q.to_vec()
    };
    let first = solve(&mut solver, 5);
    assert_eq!(first, solve(&mut solver, 5));
    let mut left = 7;
    let keep_going = || {
        left -= 1;
        left >= 0
    };
    let stopped = solver.solve(&away, &middle, &IkOptions::default(), keep_going).unwrap();
    assert_eq!((stopped.converged, stopped.iterations), (false, 7));
}

/// The cylindrical arm slides 0 to its limit along two axes: a target above it is held by one joint.
#[test]
fn a_limit_that_holds_is_named() {
    let cylindrical = load("cylindrical_rpp");
    let mut solver = IkSolver::new(arm(&cylindrical));
    let (middle, upper) = (solver.arm().middle(), solver.arm().joints()[1].upper);
    let mut q = middle.clone();
    q[1] = upper;
    let mut above = base_from_tip(&cylindrical, solver.arm(), &q).translation;
    above.z += 0.1;
    let found = solver.solve(&at(above.into()), &middle, &IkOptions::default(), || true).unwrap();
    assert!(!found.converged);
    assert_eq!(found.limits_held, [1]);
    assert!((found.residual_position_m - 0.1).abs() < 1e-6, "{found:?}");
}

#[test]
fn the_nearest_solution_is_hardly_further_than_the_one_that_made_the_target() {
    let ur5e = load("ur5e");
    let mut solver = IkSolver::new(arm(&ur5e));
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for _ in 0..10 {
        // Away from limits and from the folded elbow, where solutions meet.
        let start: ArmQ = drawn(solver.arm(), &mut random).iter().map(|q| 0.4 * q).collect();
        let joints = solver.arm().joints().iter();
        let made: ArmQ = joints.zip(&start).map(|(joint, q)| (q + 0.3).min(joint.upper)).collect();
        let base_from_tcp = base_from_tip(&ur5e, solver.arm(), &made);
        let target = IkTarget { base_from_tcp, part: TargetPart::Pose };
        let found = solver.solve_nearest(&target, &start, &IkOptions::default(), 64).unwrap();
        let distance = |q: &[f64]| q.iter().zip(&start).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        assert!(found.converged && distance(found.q) < 1.1 * distance(&made), "{found:?} for {made:?}");
    }
}
