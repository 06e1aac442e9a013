//! Servos, limits, friction, mimic joints, and repeated runs.

use congruent_description::RobotQ;
use congruent_simulation::{World, WorldSettings};
use nalgebra::Vector3;

use crate::{
    ARMS, arm, free, q0,
    support::{at, bits, make, rebuilt, run, worst},
};

/// Drift under gravity compensation, rad or m in 10 s; rounding of g(q), an equilibrium that is not stable; worst seen
/// 6.6e-12 (UR5e).
const DRIFT: f64 = 1e-9;

#[test]
fn a07_gravity_compensation() {
    for name in ARMS {
        let robot = free(name);
        let mut q0 = q0(&robot);
        robot.apply_mimic(&mut q0);
        let mut world = at(&robot, &WorldSettings::default(), &q0);
        run(&mut world, make("gravity_compensation", 0.0, 0.0).as_mut(), &q0, 10_000);
        println!("a07 {name}: {:e}", worst(world.q(), &q0));
        assert!(worst(world.q(), &q0) < DRIFT, "{name}: {:e}", worst(world.q(), &q0));
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

/// Error of `q2 = -1.5 q1`, rad; rounding; worst seen 8.9e-16 (both).
const COUPLING: f64 = 1e-12;

/// Neither arm has a joint of the arm that mimics another (the Panda has fingers, `gates.rs`): the fourth is made to
/// follow the second here.
#[test]
fn a11_a_joint_that_mimics_another() {
    for name in ARMS {
        let free = free(name);
        let [master, follower] = [1, 3].map(|row| free.joint(free.movable_joints()[row]).name.clone());
        let robot = rebuilt(&free, |parts| {
            if parts.joint.name == follower {
                parts.mimic = Some((master.clone(), -1.5, 0.0));
            }
        });
        let mut start = q0(&robot);
        robot.apply_mimic(&mut start);
        for (kind, stiffness, damping) in [("passive", 0.0, 0.0), ("pd", 200.0, 20.0)] {
            let mut world = at(&robot, &WorldSettings::default(), &start);
            let mut controller = make(kind, stiffness, damping);
            let (mut off, mut travelled) = (0.0_f64, 0.0_f64);
            for _ in 0..3000 {
                run(&mut world, controller.as_mut(), &RobotQ::zeros(start.len()), 1);
                off = off.max((world.q()[3] + 1.5 * world.q()[1]).abs());
                travelled = travelled.max((world.q()[1] - start[1]).abs());
            }
            println!("a11 {name} {kind}: {off:e} rad over {travelled} rad");
            assert!(off < COUPLING && travelled > 0.1, "{name} {kind}: {off:e} over {travelled}");
        }
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
