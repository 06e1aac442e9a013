//! The gates that need no golden file, on the UR5e and the Panda of this project. Numbers (a05 and so on) are those of
//! the table of gates.

#![expect(clippy::print_stdout, reason = "the worst values, for those who run with --nocapture")]

mod support;

use std::path::Path;

use congruent_description::{Joint, Robot, RobotQ, load_robot};
use congruent_simulation::{World, WorldSettings};
use nalgebra::{DVector, Isometry3, Vector3};
use support::{at, make, run, steps, worst};

const ARMS: [&str; 2] = ["ur5e", "panda"];

/// A robot of the project with each joint changed.
fn arm(name: &str, change: impl FnMut(&mut Joint)) -> Robot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots").join(name);
    let description = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}"));
    description.robot.with_joints(change)
}

/// Without limits, damping and friction.
fn free(name: &str) -> Robot {
    arm(name, |joint| (joint.damping, joint.friction, joint.limit) = (0.0, 0.0, None))
}

/// 0.3 + 0.1 i at joints that turn, away from every symmetry; 0.02 m at those that slide.
fn q0(robot: &Robot) -> RobotQ {
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    let at = |(row, joint): (usize, &Joint)| {
        if joint.kind.is_angular() {
            0.3 + 0.1 * f64::from(u8::try_from(row).expect("few joints"))
        } else {
            0.02
        }
    };
    joints.map(at).collect()
}

fn with_step(step_s: f64) -> WorldSettings {
    WorldSettings { step_s, ..WorldSettings::default() }
}

/// Kinetic and potential energy, J; the potential from the poses of links and their masses.
fn energy_j(robot: &Robot, world: &World) -> f64 {
    let mut root_from_links = vec![Isometry3::identity(); robot.links().len()];
    world.root_from_links_into(&mut root_from_links);
    let weights = robot.links().iter().zip(&root_from_links).filter_map(|(link, root_from_link)| {
        let inertia = link.inertia?;
        let height_m = (root_from_link * inertia.link_from_inertial).translation.vector.z;
        Some(inertia.mass_kg * 9.81 * height_m)
    });
    let qd = DVector::from_row_slice(world.qd());
    weights.sum::<f64>() + 0.5 * qd.dot(&(world.mass_matrix() * &qd))
}

/// Ratio of the errors at h and h/2, physics (first order): 2 + O(h).
const FIRST_ORDER: std::ops::Range<f64> = 1.9..2.1;

/// After 0.3 s, of differences between steps that are halved, and of the energy.
#[test]
fn a05_free_swing_and_its_energy_are_of_first_order() {
    for name in ARMS {
        let robot = free(name);
        let q0 = q0(&robot);
        let swing = |step_s: f64| {
            let mut world = at(&robot, &with_step(step_s), &q0);
            let before_j = energy_j(&robot, &world);
            run(&mut world, make("passive", 0.0, 0.0).as_mut(), &q0, steps(0.3, step_s));
            (world.q().to_vec(), energy_j(&robot, &world) - before_j)
        };
        let ends = [5e-4, 2.5e-4, 1.25e-4].map(swing);
        let apart = [worst(&ends[0].0, &ends[1].0), worst(&ends[1].0, &ends[2].0)];
        let gained_j = ends.map(|(_, gained_j)| gained_j);
        println!("a05 {name}: {apart:?} rad, {gained_j:?} J");
        assert!(FIRST_ORDER.contains(&(apart[0] / apart[1])), "{name}: {apart:?}");
        assert!(FIRST_ORDER.contains(&(gained_j[0] / gained_j[1])), "{name}: {gained_j:?}");
    }
}

/// Sag of a servo against gravity torque / stiffness, rad or m.
const SAG: f64 = 1e-8;

#[test]
fn a08_a_servo_sags_by_gravity_torque_over_stiffness() {
    for name in ARMS {
        let robot = arm(name, |joint| joint.limit = None);
        let mut q0 = q0(&robot);
        robot.apply_mimic(&mut q0);
        let mut world = at(&robot, &WorldSettings::default(), &q0);
        run(&mut world, make("pd", 2000.0, 200.0).as_mut(), &q0, 6000);
        let gravity = world.gravity_torque();
        // Fingers that are coupled share one servo.
        let arm =
            robot.movable_joints().iter().filter(|&&joint| robot.joint(joint).kind.is_angular()).count();
        let off = |row: usize| (q0[row] - world.q()[row] - gravity[row] / 2000.0).abs();
        let off = (0..arm).map(off).fold(0.0, f64::max);
        println!("a08 {name}: {off:e}");
        assert!(off < SAG, "{name}: {off:e}");
    }
}

#[test]
fn a09_a_limit_is_overshot_by_less_than_two_steps() {
    for name in ARMS {
        let robot = arm(name, |joint| joint.friction = 0.0);
        let (_, upper) = robot.joint(robot.movable_joints()[0]).position_range().unwrap();
        let settings = WorldSettings { gravity_in_world: Vector3::zeros(), ..WorldSettings::default() };
        let middle = |&joint: &_| {
            robot.joint(joint).position_range().map_or(0.0, |(lower, upper)| 0.5 * (lower + upper))
        };
        let mut q: RobotQ = robot.movable_joints().iter().map(middle).collect();
        robot.apply_mimic(&mut q);
        q[0] = upper - 0.1;
        let (speed, mut qd) = (2.0, vec![0.0; q.len()]);
        qd[0] = speed;
        let mut world = World::new(&robot, &settings).unwrap();
        world.set_state(&q, &qd).unwrap();
        let mut overshoot = 0.0_f64;
        for _ in 0..200 {
            run(&mut world, make("passive", 0.0, 0.0).as_mut(), &q, 1);
            overshoot = overshoot.max(world.q()[0] - upper);
        }
        println!("a09 {name}: {overshoot:e}");
        assert!(overshoot > 0.0 && overshoot <= 2.0 * speed * 1e-3, "{name}: {overshoot}");
    }
}

/// Creep under dry friction above gravity, rad or m in 5 s; solver stop.
const CREEP: f64 = 1e-4;

#[test]
fn a10_friction_above_gravity_sticks() {
    for name in ARMS {
        let robot = arm(name, |joint| (joint.friction, joint.limit) = (80.0, None));
        let mut q0 = q0(&robot);
        robot.apply_mimic(&mut q0);
        let mut world = at(&robot, &WorldSettings::default(), &q0);
        run(&mut world, make("passive", 0.0, 0.0).as_mut(), &q0, 5000);
        println!("a10 {name}: {:e}", worst(world.q(), &q0));
        assert!(worst(world.q(), &q0) < CREEP, "{name}: {:e}", worst(world.q(), &q0));
    }
}

/// Effort of a servo against its limit, N m; rounding.
const EFFORT_N_M: f64 = 1e-9;

#[test]
fn a12_effort_limits_clip_servos() {
    for name in ARMS {
        let robot = arm(name, |joint| {
            if let Some(limit) = &mut joint.limit {
                (limit.effort, limit.lower, limit.upper) = (Some(20.0), -10.0, 10.0);
            }
        });
        let start = q0(&robot);
        let mut world = at(&robot, &WorldSettings::default(), &start);
        run(&mut world, make("pd", 1e5, 1e3).as_mut(), &RobotQ::from(vec![3.0; start.len()]), 1);
        println!("a12 {name}: {:?}", world.torque());
        assert!((world.torque()[0] - 20.0).abs() < EFFORT_N_M, "{name}: {:?}", world.torque());
        assert!(world.torque().iter().all(|torque| torque.abs() <= 20.0 + EFFORT_N_M), "{name}");
        assert!(world.saturations()[0].effort, "{name}");
    }
}

#[test]
fn a13_repeated_and_restored_runs_are_equal_bit_by_bit() {
    for name in ARMS {
        let robot = arm(name, |_| {});
        let q0 = q0(&robot);
        let target = RobotQ::from(vec![0.1; q0.len()]);
        let bits = |world: &World| {
            let numbers = world.q().iter().chain(world.qd()).chain(world.torque());
            numbers.map(|number| number.to_bits()).collect::<Vec<u64>>()
        };
        for kind in ["passive", "pd"] {
            let mut controller = make(kind, 300.0, 20.0);
            let mut first = at(&robot, &WorldSettings::default(), &q0);
            run(&mut first, controller.as_mut(), &target, 500);
            let snapshot = first.snapshot();
            run(&mut first, controller.as_mut(), &target, 500);
            let mut second = at(&robot, &WorldSettings::default(), &q0);
            run(&mut second, controller.as_mut(), &target, 1000);
            assert_eq!(bits(&first), bits(&second), "{name} {kind}: repeated");
            second.restore(&snapshot);
            run(&mut second, controller.as_mut(), &target, 500);
            assert_eq!(bits(&first), bits(&second), "{name} {kind}: restored");
        }
    }
}
