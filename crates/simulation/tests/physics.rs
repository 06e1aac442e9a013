//! What a correct twin does with robots that no file has: slides that follow hinges, contacts, controllers from outside.
//! Numbers (a07 and so on) are those of the table of gates, which `arms/` holds for real arms, and `gates.rs` for goldens.

#![expect(clippy::print_stdout, reason = "the worst values, for those who run with --nocapture")]

mod support;

use congruent_description::{Geometry, Obstacle, RobotQ};
use congruent_simulation::{Commands, Controller, Gains, JointsView, Motor, Setpoint, World, WorldSettings};
use nalgebra::{Isometry3, Vector3};

use support::{
    arm, arm_q0, arm_with, at, bits, limited, make, mimic_arm, run, sliding_block, swinging_bar, worst,
};

/// Drift under gravity compensation, rad in 10 s; rounding of g(q), an equilibrium that is not
/// stable; worst seen 8.5e-12.
const DRIFT_RAD: f64 = 1e-9;

#[test]
fn a07_gravity_compensation_holds_slides_and_followers() {
    let robot = mimic_arm();
    let mut q0 = RobotQ::from([0.4, 0.0, 0.0]);
    robot.apply_mimic(&mut q0);
    let mut world = at(&robot, &WorldSettings::default(), &q0);
    run(&mut world, make("gravity_compensation", 0.0, 0.0).as_mut(), &q0, 10_000);
    println!("a07 mimic: {:e}", worst(world.q(), &q0));
    assert!(worst(world.q(), &q0) < DRIFT_RAD, "{:?}", world.q());
}

/// Speed of a return against 1 rad/s; physics, a limit gives way by 1 / (pi f h) with f = 1 MHz, which
/// is 3.2e-4; worst seen 3.2e-4.
const RETURN_RAD_PER_S: f64 = 1e-3;

#[test]
fn a_joint_placed_outside_its_limits_returns_at_1_rad_per_s() {
    let robot = arm_with(|parts| limited(parts, (-0.5, 0.5), 0.0));
    let settings = WorldSettings { gravity_in_world: Vector3::zeros(), ..WorldSettings::default() };
    let mut world = at(&robot, &settings, &arm_q0());
    let mut passive = make("passive", 0.0, 0.0);
    let mut off = 0.0_f64;
    for _ in 0..400 {
        let before = world.q().to_vec();
        run(&mut world, passive.as_mut(), &RobotQ::zeros(6), 1);
        let outside = before.iter().zip(world.q()).filter(|(before, _)| **before > 0.501);
        off = outside.map(|(before, after)| ((before - after) / 1e-3 - 1.0).abs()).fold(off, f64::max);
    }
    println!("return: {off:e}");
    assert!(off < RETURN_RAD_PER_S, "{off:e}");
    assert!(world.q().iter().all(|q| q.abs() < 0.5 + 1e-3), "{:?}", world.q());
}

/// Error of `q = multiplier * master + offset`, rad or m; rounding, some eps; worst seen 1.8e-15.
const COUPLING: f64 = 1e-12;

#[test]
fn a11_mimic_joints_follow_their_master() {
    let robot = mimic_arm();
    let mut q0 = RobotQ::from([0.4, 0.0, 0.0]);
    robot.apply_mimic(&mut q0);
    for kind in ["passive", "pd"] {
        let mut world = at(&robot, &WorldSettings::default(), &q0);
        let mut controller = make(kind, 50.0, 5.0);
        let mut off = 0.0_f64;
        for _ in 0..3000 {
            run(&mut world, controller.as_mut(), &RobotQ::from([-0.3, 0.55, -0.11]), 1);
            let mut expected = world.q().clone();
            robot.apply_mimic(&mut expected);
            off = off.max(worst(world.q(), &expected));
        }
        println!("a11 {kind}: {off:e}");
        assert!(off < COUPLING, "{kind}: {off:e}");
        assert!((world.q()[0] - 0.4).abs() > 0.1, "{kind}: it moved");
    }
}

/// Torque of a servo against its effort limit, N m; rounding of 40 sweeps; worst seen 3.6e-14.
const EFFORT_N_M: f64 = 1e-9;

#[test]
fn a12_clipped_torques_are_those_that_act() {
    let robot = arm_with(|parts| limited(parts, (-6.0, 6.0), 20.0));
    // Without gravity the acceleration shows what acted.
    let settings =
        WorldSettings { gravity_in_world: Vector3::zeros(), step_s: 1e-6, ..WorldSettings::default() };
    let mut world = at(&robot, &settings, &arm_q0());
    let mass_matrix = world.mass_matrix();
    run(&mut world, make("pd", 1e5, 1e3).as_mut(), &RobotQ::from([3.0; 6]), 1);
    let acceleration = nalgebra::DVector::from_row_slice(world.qd()) / 1e-6;
    let acted = mass_matrix * acceleration;
    println!("a12: {:e}", worst(acted.as_slice(), &[20.0; 6]));
    assert!(worst(acted.as_slice(), &[20.0; 6]) < EFFORT_N_M, "{acted}");
}

#[test]
fn a13_runs_and_restored_runs_are_equal_bit_by_bit() {
    let obstacle = Obstacle {
        name: "floor".into(),
        world_from_obstacle: Isometry3::translation(0.0, 0.0, -0.6),
        geometry: Geometry::Box { size_m: Vector3::new(4.0, 4.0, 0.2) },
    };
    let settings = WorldSettings { contacts: true, obstacles: vec![obstacle], ..WorldSettings::default() };
    for (robot, q0) in [
        (arm(), arm_q0()),
        (mimic_arm(), RobotQ::from([0.4, -0.5, 0.03])),
        (swinging_bar(), RobotQ::zeros(1)),
    ] {
        for kind in ["passive", "kinematic", "pd", "gravity_compensation"] {
            let target = RobotQ::from(vec![0.1; q0.len()]);
            let mut controller = make(kind, 300.0, 20.0);
            let mut first = at(&robot, &settings, &q0);
            run(&mut first, controller.as_mut(), &target, 700);
            let snapshot = first.snapshot();
            run(&mut first, controller.as_mut(), &target, 700);

            let mut second = at(&robot, &settings, &q0);
            run(&mut second, controller.as_mut(), &target, 1400);
            assert_eq!(bits(&first), bits(&second), "{} {kind}: repeated", robot.name());

            second.restore(&snapshot);
            assert_eq!(second.step_count(), 700);
            run(&mut second, controller.as_mut(), &target, 700);
            assert_eq!(bits(&first), bits(&second), "{} {kind}: restored", robot.name());
        }
    }
}

#[test]
fn an_obstacle_stops_a_servo() {
    let floor = Obstacle {
        name: "floor".into(),
        world_from_obstacle: Isometry3::translation(1.0, 0.0, -0.4),
        geometry: Geometry::Box { size_m: Vector3::new(1.0, 1.0, 0.1) },
    };
    let end = |contacts| {
        let obstacles = vec![floor.clone()];
        let settings = WorldSettings { contacts, obstacles, ..WorldSettings::default() };
        let mut world = at(&swinging_bar(), &settings, &RobotQ::zeros(1));
        run(&mut world, make("pd", 100.0, 20.0).as_mut(), &RobotQ::from([1.2]), 4000);
        world.q()[0]
    };
    let (stopped, free) = (end(true), end(false));
    println!("contact: {stopped} {free}");
    assert!((0.2..0.5).contains(&stopped) && free > 1.1, "{stopped} {free}");
}

#[test]
fn shapes_that_are_balls_while_they_are_far_change_no_motion() {
    let floor = Obstacle {
        name: "floor".into(),
        world_from_obstacle: Isometry3::translation(1.0, 0.0, -0.4),
        geometry: Geometry::Box { size_m: Vector3::new(1.0, 1.0, 0.1) },
    };
    // Beside an obstacle that may move, every shape stays its own.
    let world_from_obstacle = Isometry3::translation(50.0, 0.0, 0.0);
    let moving = Obstacle { name: "moving".into(), world_from_obstacle, ..floor.clone() };
    let motion = |obstacles: Vec<Obstacle>| {
        let moving_obstacles = (1..obstacles.len()).collect();
        let settings =
            WorldSettings { contacts: true, obstacles, moving_obstacles, ..WorldSettings::default() };
        let mut world = at(&swinging_bar(), &settings, &RobotQ::from([-1.2]));
        let mut bounced = false;
        let mut part = |target: f64| {
            run(&mut world, make("pd", 40.0, 2.0).as_mut(), &RobotQ::from([target]), 100);
            bounced |= world.contact_acts();
            bits(&world)
        };
        // Down onto the floor, up, and down again.
        let parts: Vec<_> =
            [1.2, -1.2, 1.2].into_iter().flat_map(|target| [target; 15]).map(&mut part).collect();
        assert!(bounced, "the bar meets the floor");
        parts
    };
    assert_eq!(motion(vec![floor.clone()]), motion(vec![floor.clone(), moving]));
}

/// Change of the penetration when the load goes from 100 N m/rad to the bar's own weight, rad;
/// physics, contacts of 60 Hz give way; worst seen 7.8e-4.
const RESTING_RAD: f64 = 5e-3;

#[test]
fn a_robot_placed_on_an_obstacle_rests_there() {
    let floor = Obstacle {
        name: "floor".into(),
        world_from_obstacle: Isometry3::translation(1.0, 0.0, -0.4),
        geometry: Geometry::Box { size_m: Vector3::new(1.0, 1.0, 0.1) },
    };
    let settings = WorldSettings { contacts: true, obstacles: vec![floor], ..WorldSettings::default() };
    let mut world = at(&swinging_bar(), &settings, &RobotQ::zeros(1));
    run(&mut world, make("pd", 100.0, 20.0).as_mut(), &RobotQ::from([1.2]), 4000);
    let resting = world.q()[0];
    let mut kinematic = make("kinematic", 0.0, 0.0);
    run(&mut world, kinematic.as_mut(), &RobotQ::from([-1.0]), 10);
    run(&mut world, kinematic.as_mut(), &RobotQ::from([resting]), 1);
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(1), 500);
    println!("resting: {:e}", world.q()[0] - resting);
    assert!((world.q()[0] - resting).abs() < RESTING_RAD, "{} {resting}", world.q()[0]);
}

/// A floor, on whose surface the sliding block is at z = 0.05 m, under gravity that pulls along x with this share.
fn on_floor(share: f64, friction: f64, restitution: f64) -> WorldSettings {
    let floor = Obstacle {
        name: "floor".into(),
        world_from_obstacle: Isometry3::translation(0.0, 0.0, -0.5),
        geometry: Geometry::Box { size_m: Vector3::new(40.0, 4.0, 1.0) },
    };
    WorldSettings {
        contacts: true,
        obstacles: vec![floor],
        gravity_in_world: Vector3::new(9.81 * share, 0.0, -9.81),
        contact_friction: friction,
        contact_restitution: restitution,
        ..WorldSettings::default()
    }
}

/// Contact force at rest against the weight, relative; solver stop and a resting contact that gives way; worst seen 3e-5.
const WEIGHT: f64 = 1e-3;

#[test]
fn an_obstacle_pushes_with_the_weight_that_rests_on_it() {
    let mut world = at(&sliding_block(), &on_floor(0.0, 0.5, 0.0), &RobotQ::from([0.0, 0.05]));
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(2), 2000);
    let forces: Vec<_> = world.contact_forces().collect();
    let [force] = forces[..] else { panic!("{forces:?}") };
    assert_eq!((force.link, force.obstacle), (2, 0));
    let weight_n = 2.0 * 9.81;
    println!("weight: {:e}", force.force_n / weight_n - 1.0);
    assert!((force.force_n / weight_n - 1.0).abs() < WEIGHT, "{force:?}");
    // In the air nothing pushes.
    let mut world = at(&sliding_block(), &on_floor(0.0, 0.5, 0.0), &RobotQ::from([0.0, 1.0]));
    run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(2), 10);
    assert_eq!(world.contact_forces().count(), 0);
}

/// Share of the path of a slide with friction against the closed form; physics, the block settles at first; worst seen 2e-3.
const SLID: f64 = 0.02;

#[test]
fn friction_holds_up_to_its_coefficient_and_brakes_beyond() {
    let slid_m = |friction| {
        let mut world = at(&sliding_block(), &on_floor(0.3, friction, 0.0), &RobotQ::from([0.0, 0.05]));
        run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(2), 1000);
        world.q()[0]
    };
    // In 1 s from rest: a = g (0.3 - friction).
    for friction in [0.0, 0.1, 0.2] {
        let expected_m = 0.5 * 9.81 * (0.3 - friction);
        println!("friction {friction}: {} {expected_m}", slid_m(friction));
        assert!(
            (slid_m(friction) / expected_m - 1.0).abs() < SLID,
            "{friction}: {} {expected_m}",
            slid_m(friction)
        );
    }
    assert!(slid_m(0.4).abs() < 1e-3, "{}", slid_m(0.4));
}

/// Share of the height of a bounce; physics, a step of 1 ms at the impact; worst seen 0.03.
const BOUNCE: f64 = 0.06;

#[test]
fn restitution_is_the_share_of_the_speed_after_an_impact() {
    for restitution in [0.0, 0.5, 0.8] {
        let mut world = at(&sliding_block(), &on_floor(0.0, 0.5, restitution), &RobotQ::from([0.0, 0.55]));
        let mut highest_m: f64 = 0.0;
        let mut has_met = false;
        for _ in 0..700 {
            run(&mut world, make("passive", 0.0, 0.0).as_mut(), &RobotQ::zeros(2), 1);
            has_met |= world.contact_acts();
            if has_met {
                highest_m = highest_m.max(world.q()[1] - 0.05);
            }
        }
        // From 0.5 m; the height goes with the square of the speed.
        let expected_m = 0.5 * restitution * restitution;
        println!("restitution {restitution}: {highest_m} {expected_m}");
        assert!((highest_m - expected_m).abs() < BOUNCE * 0.5, "{restitution}: {highest_m} {expected_m}");
    }
}

#[test]
fn kinematic_is_exactly_at_the_setpoint() {
    let robot = arm_with(|parts| limited(parts, (-0.1, 0.1), 1.0));
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    let mut kinematic = make("kinematic", 0.0, 0.0);
    for step in 1..=100_u32 {
        let q: RobotQ = arm_q0().iter().map(|q| q * f64::from(step) * 0.1).collect();
        let qd: Vec<f64> = arm_q0().iter().map(|q| -q).collect();
        world.step(kinematic.as_mut(), &Setpoint { q: &q, qd: &qd, qdd: &[0.0; 6] }).unwrap();
        assert_eq!((world.q(), world.qd()), (&q, &qd[..]));
        assert_eq!(world.step_count(), u64::from(step));
        assert_eq!(world.time_s().to_bits(), (f64::from(step) * 1e-3).to_bits());
    }
}

/// Poses against the product of the joints' transforms, m and quaternion entries; rounding of
/// eight products of 1 m; worst seen 1e-15.
const POSE: f64 = 1e-12;

#[test]
fn a01_poses_are_those_of_the_coordinates() {
    let robot = arm();
    let mut world = at(&robot, &WorldSettings::default(), &RobotQ::from([7.0, -8.0, 0.1, 2.0, -1.0, 20.0]));
    let mut passive = make("passive", 0.0, 0.0);
    for _ in 0..3 {
        let mut poses = vec![Isometry3::identity(); robot.links().len()];
        world.root_from_links_into(&mut poses);
        for link in robot.link_indices() {
            assert_eq!(world.root_from_link(link), poses[link.get()]);
            let Some(index) = robot.parent_joint(link) else { continue };
            let joint = robot.joint(index);
            let q = robot.coordinate(index).map_or(0.0, |coordinate| world.q()[coordinate]);
            let turn = nalgebra::UnitQuaternion::from_axis_angle(&joint.axis_in_joint, q);
            let expected = poses[joint.parent.get()] * joint.parent_from_joint * turn;
            let error = expected.to_homogeneous() - poses[link.get()].to_homogeneous();
            assert!(error.amax() < POSE, "{}: {error}", joint.name);
        }
        run(&mut world, passive.as_mut(), &RobotQ::zeros(6), 40);
    }
}

/// A controller from outside the crate: a servo on one joint only.
#[derive(Clone)]
struct OneServo;

impl Controller for OneServo {
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        joints.add_gravity_torque(commands.torque_mut());
        let gains = Gains { stiffness: 500.0, damping: 100.0 };
        commands.drive(5, Motor { gains, q: setpoint.q[5], qd: setpoint.qd[5] });
    }
}

#[test]
fn controllers_can_come_from_outside() {
    let mut world = at(&arm(), &WorldSettings::default(), &arm_q0());
    run(&mut world, &mut OneServo, &RobotQ::zeros(6), 4000);
    assert!(world.q()[5].abs() < 1e-3, "{:?}", world.q());
}

#[test]
fn a_world_may_move_to_another_thread() {
    fn is_send<T: Send>() {}
    is_send::<World>();
    is_send::<congruent_simulation::WorldSnapshot>();
}
