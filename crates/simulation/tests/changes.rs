//! Changes of a robot while it runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use congruent_description::{CarriedBody, Inertia};
use congruent_simulation::{DriveConnection, MeasuredState, Setpoint, SimulationError, World, WorldSettings};
use nalgebra::{Isometry3, Matrix3, Vector3};

/// Sums of a few products; worst seen 3e-16 of the largest.
const ROUNDING: f64 = 1e-13;

fn load() -> Inertia {
    let link_from_inertial = Isometry3::new(Vector3::new(0.02, -0.01, 0.08), Vector3::new(0.3, 0.1, -0.2));
    let tensor_kg_m2 = Matrix3::from_diagonal(&Vector3::new(0.004, 0.005, 0.002));
    Inertia { mass_kg: 2.5, link_from_inertial, tensor_kg_m2 }
}

#[test]
fn what_is_carried_is_as_what_was_built_in() {
    let robot = support::arm();
    let tool = robot.find_link("tool").unwrap();
    let mut built_in = World::new(&support::arm_carrying(&load()), &WorldSettings::default()).unwrap();
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    for world in [&mut built_in, &mut world] {
        world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    }
    let before = world.mass_matrix();
    world.set_carried(&[CarriedBody { link: tool, inertia: load() }]);
    let scale = built_in.mass_matrix().norm();
    assert!((world.mass_matrix() - built_in.mass_matrix()).norm() < ROUNDING * scale);
    assert!(
        (world.gravity_torque() - built_in.gravity_torque()).norm()
            < ROUNDING * built_in.gravity_torque().norm()
    );
    world.set_carried(&[]);
    assert!((world.mass_matrix() - before).norm() < ROUNDING * scale);
}

#[test]
fn the_armature_of_a_description_is_in_the_mass_matrix() {
    let robot = support::arm();
    let armature = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let mut values = armature.into_iter();
    let with_armature = robot.with_joints(|joint| {
        joint.armature = if joint.kind.is_movable() { values.next() } else { None };
    });
    let [without, with] = [&robot, &with_armature].map(|robot| {
        let mut world = World::new(robot, &WorldSettings::default()).unwrap();
        world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
        world.mass_matrix()
    });
    let added = with - &without;
    let expected = nalgebra::DMatrix::from_diagonal(&nalgebra::DVector::from_row_slice(&armature));
    assert!((added - expected).norm() < ROUNDING * without.norm());
}

#[test]
fn a_joint_of_very_large_damping_is_at_rest() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.5; 6]).unwrap();
    world.set_damping(2, 1e9).unwrap();
    let mut passive = support::make("passive", 0.0, 0.0);
    for _ in 0..500 {
        world
            .step(passive.as_mut(), &Setpoint { q: &support::arm_q0(), qd: &[0.0; 6], qdd: &[0.0; 6] })
            .unwrap();
    }
    // Gravity and the other joints push with less than 100 N m: 1e-7 rad/s for 0.5 s.
    assert!((world.q()[2] - support::arm_q0()[2]).abs() < 5e-8, "{}", world.q()[2] - support::arm_q0()[2]);
    assert!((world.q()[1] - support::arm_q0()[1]).abs() > 0.1, "the others move on");
}

#[test]
fn an_actuator_delivers_a_share_of_its_command() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    let mut pd = support::make("pd", 100.0, 5.0);
    world.set_delivered_share(1, 0.0).unwrap();
    world.set_delivered_share(2, 0.5).unwrap();
    let mut target = support::arm_q0();
    target.iter_mut().for_each(|q| *q += 0.01);
    world.step(pd.as_mut(), &Setpoint { q: &target, qd: &[0.0; 6], qdd: &[0.0; 6] }).unwrap();
    assert_eq!(world.torque()[1].to_bits(), 0.0_f64.to_bits());
    let expected = 0.5 * (100.0 * (target[2] - world.q()[2]) - 5.0 * world.qd()[2]);
    assert!((world.torque()[2] - expected).abs() < 1e-12, "{} for {expected}", world.torque()[2]);
}

#[test]
fn a_servo_acts_on_what_the_encoder_gives() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    let mut pd = support::make("pd", 2000.0, 200.0);
    let offset_rad = 0.02;
    for _ in 0..4000 {
        let mut measured = world.q().clone();
        measured[4] += offset_rad;
        let qd = world.qd().to_vec();
        let measured = MeasuredState { q: &measured, qd: &qd };
        world
            .step_measured(
                pd.as_mut(),
                &Setpoint { q: &support::arm_q0(), qd: &[0.0; 6], qdd: &[0.0; 6] },
                &measured,
            )
            .unwrap();
    }
    let sag_rad = -world.gravity_torque()[4] / 2000.0;
    let error_rad = world.q()[4] - support::arm_q0()[4];
    assert!((error_rad - (sag_rad - offset_rad)).abs() < 1e-6, "{error_rad} for {}", sag_rad - offset_rad);
}

#[test]
fn a_resistance_below_zero_is_refused() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    for refused in [
        world.set_damping(0, -1.0),
        world.set_dry_friction(0, f64::NAN),
        world.set_armature(0, f64::INFINITY),
        world.set_delivered_share(0, -0.5),
    ] {
        assert!(matches!(refused, Err(SimulationError::Resistance { .. })), "{refused:?}");
    }
}

#[test]
fn an_unknown_load_weighs_in_addition_to_a_known_one() {
    let robot = support::arm();
    let link = robot.find_link("tool").unwrap();
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    let unloaded = world.gravity_torque();
    let carried = [CarriedBody { link, inertia: load() }];
    world.set_carried(&carried);
    let loaded = world.gravity_torque();
    world.set_carried_unknown(&carried);
    let twice = &unloaded + (&loaded - &unloaded) * 2.0;
    assert!((&loaded - &unloaded).norm() > 1.0, "it weighs");
    assert!((world.gravity_torque() - &twice).norm() < ROUNDING * twice.norm());
    world.set_carried(&[]);
    assert!((world.gravity_torque() - &loaded).norm() < ROUNDING * loaded.norm());
    world.set_carried_unknown(&[]);
    assert!((world.gravity_torque() - &unloaded).norm() < ROUNDING * unloaded.norm());
}

#[test]
fn a_drive_that_is_connected_elsewhere_gets_the_commands_of_there() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    world.set_connection(1, DriveConnection { commanded_as: 2, is_reversed: true });
    world.set_connection(2, DriveConnection { commanded_as: 1, is_reversed: false });
    let mut pd = support::make("pd", 100.0, 5.0);
    let q = support::arm_q0();
    let mut target = q.clone();
    target[2] += 0.01;
    let measured = MeasuredState { q: &q, qd: &[0.0; 6] };
    world
        .step_measured(pd.as_mut(), &Setpoint { q: &target, qd: &[0.0; 6], qdd: &[0.0; 6] }, &measured)
        .unwrap();
    let expected = 100.0 * (q[1] - 0.01 - world.q()[1]) - 5.0 * world.qd()[1];
    assert!((world.torque()[1] - expected).abs() < 1e-12, "{} for {expected}", world.torque()[1]);
}

#[test]
fn a_drive_reports_what_it_is_asked_for() {
    let mut world = World::new(&support::arm(), &WorldSettings::default()).unwrap();
    world.set_state(&support::arm_q0(), &[0.0; 6]).unwrap();
    world.set_delivered_share(1, 0.25).unwrap();
    let mut pd = support::make("pd", 100.0, 5.0);
    let mut target = support::arm_q0();
    target.iter_mut().for_each(|q| *q += 0.01);
    world.step(pd.as_mut(), &Setpoint { q: &target, qd: &[0.0; 6], qdd: &[0.0; 6] }).unwrap();
    assert!((world.torque()[1] - 0.25 * world.asked_torque()[1]).abs() < 1e-12);
    assert_eq!(world.torque()[2].to_bits(), world.asked_torque()[2].to_bits());
}
