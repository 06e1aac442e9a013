//! Each error, and that it says what to do.

mod support;

use std::sync::Arc;

use congruent_description::{Geometry, JointKind, JointParts, Link, Mesh, Obstacle, Robot, RobotQ};
use congruent_simulation::{
    Commands, Controller, JointsView, Setpoint, SimulationError, World, WorldSettings,
};
use nalgebra::{Isometry3, Point3, Vector3};

use support::{arm, arm_q0, arm_with, limited, make, massless, pendulum, run};

fn refused(settings: &WorldSettings) -> SimulationError {
    World::new(&pendulum(), settings).err().expect("the settings are bad")
}

#[test]
fn settings_out_of_range() {
    for step_s in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let error = refused(&WorldSettings { step_s, ..WorldSettings::default() });
        assert!(matches!(error, SimulationError::Step { .. }), "{error}");
    }
    let gravity_in_world = Vector3::new(0.0, f64::NAN, 0.0);
    let error = refused(&WorldSettings { gravity_in_world, ..WorldSettings::default() });
    assert_eq!(error.to_string(), "gravity [0, NaN, 0] m/s2 is not finite");
}

#[test]
fn limits_that_exclude_each_other() {
    let robot = arm_with(|parts| limited(parts, (1.0, -1.0), 0.0));
    let error = World::new(&robot, &WorldSettings::default()).err().unwrap();
    let expected = "joint \"shoulder_joint\": the lower limit 1 rad is above the upper limit -1 rad";
    assert_eq!(error.to_string(), expected);
}

/// A star of 1000 joints, which the physics took minutes for, and 5000 that took 4 GB.
#[test]
fn more_joints_than_the_physics_can_carry() {
    let robot = |joints: usize| {
        let link = |name: String| Link { name, ..Link::default() };
        let links = (0..=joints).map(|index| link(index.to_string())).collect();
        let joint = |index: usize| {
            let (name, child) = (format!("j{index}"), index.to_string());
            JointParts::new(&name, JointKind::Continuous, "0", &child, Isometry3::identity())
        };
        Robot::new("star", links, (1..=joints).map(joint).collect()).unwrap()
    };
    let error = World::new(&robot(301), &WorldSettings::default()).err().unwrap();
    assert_eq!(error, SimulationError::TooManyJoints { joints: 301, most: 300 });
    assert!(World::new(&robot(300), &WorldSettings::default()).is_ok());
}

fn mesh_obstacle(vertices_m: Vec<Point3<f64>>) -> WorldSettings {
    let mesh = Mesh { path: "sheet.stl".into(), scale: Vector3::repeat(1.0), vertices_m, triangles: vec![] };
    let obstacle = Obstacle {
        name: "sheet".into(),
        world_from_obstacle: Isometry3::identity(),
        geometry: Geometry::Mesh(Arc::new(mesh)),
    };
    WorldSettings { contacts: true, obstacles: vec![obstacle], ..WorldSettings::default() }
}

#[test]
fn a_shape_without_a_hull() {
    let line = (0..4).map(|i| Point3::new(f64::from(i), 0.0, 0.0)).collect();
    let error = refused(&mesh_obstacle(line));
    assert_eq!(error, SimulationError::Shape { owner: "obstacle \"sheet\"".into() });
    assert!(World::new(&pendulum(), &mesh_obstacle(vec![])).is_ok(), "an empty mesh touches nothing");
}

#[test]
fn vectors_of_another_length() {
    let mut world = World::new(&arm(), &WorldSettings::default()).unwrap();
    let error = world.set_state(&RobotQ::zeros(5), &[0.0; 6]).unwrap_err();
    assert_eq!(error.to_string(), "position: 5 entries, but the robot has 6 movable joints");
    let setpoint = Setpoint { q: &RobotQ::zeros(6), qd: &[], qdd: &[0.0; 6] };
    let error = world.step(make("passive", 0.0, 0.0).as_mut(), &setpoint).unwrap_err();
    assert_eq!(error, SimulationError::Length { what: "setpoint velocity", found: 0, expected: 6 });
    assert_eq!(world.step_count(), 0);
}

#[test]
fn a_robot_without_mass_is_placed_but_not_stepped() {
    let parts =
        support::joint(congruent_description::JointKind::Continuous, ("base", "arm"), [0.0; 3], [0.0; 3]);
    let robot = Robot::new("ghost", vec![massless("base"), massless("arm")], vec![parts]).unwrap();
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    let setpoint = Setpoint { q: &RobotQ::from([0.5]), qd: &[0.0], qdd: &[0.0] };
    let error = world.step(make("passive", 0.0, 0.0).as_mut(), &setpoint).unwrap_err();
    assert_eq!(
        error.to_string(),
        "link \"arm\" and every link that it carries have no mass; give it an <inertial>, or use the controller kinematic"
    );
    world.step(make("kinematic", 0.0, 0.0).as_mut(), &setpoint).unwrap();
    assert_eq!(world.q()[..], [0.5]);
}

#[test]
fn a_robot_without_a_joint_is_at_rest() {
    let robot = Robot::new("table", vec![massless("table")], vec![]).unwrap();
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    run(&mut world, make("pd", 1.0, 1.0).as_mut(), &RobotQ::zeros(0), 3);
    assert_eq!(world.root_from_link(robot.root()), Isometry3::identity());
    assert_eq!((world.mass_matrix().len(), world.gravity_torque().len(), world.step_count()), (0, 0, 3));
}

/// Commands the same torque at every joint.
#[derive(Clone)]
struct Push(f64);

impl Controller for Push {
    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, commands: &mut Commands) {
        commands.torque_mut().fill(self.0);
    }
}

#[test]
fn numbers_that_are_none() {
    let mut world = World::new(&arm(), &WorldSettings::default()).unwrap();
    let error = world.set_state(&RobotQ::from([0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]), &[0.0; 6]).unwrap_err();
    assert_eq!(error.to_string(), "joint \"forearm_joint\": position is not finite at 0 s");
    let setpoint = Setpoint { q: &RobotQ::zeros(6), qd: &[0.0; 6], qdd: &[0.0; 6] };
    for torque in [f64::NAN, f64::NEG_INFINITY, 1e200] {
        let error = world.step(&mut Push(torque), &setpoint).unwrap_err();
        assert_eq!(error.to_string(), "joint \"shoulder_joint\": commanded torque is not finite at 0 s");
    }
    assert_eq!(world.q()[..], [0.0; 6]);
}

#[test]
fn physics_that_runs_away_is_an_error_and_can_be_left() {
    let robot = arm_with(|mut parts| {
        parts.joint.limit = None;
        parts
    });
    let mut world = World::new(&robot, &WorldSettings::default()).unwrap();
    world.set_state(&arm_q0(), &[0.0; 6]).unwrap();
    let before = world.snapshot();
    let mut passive = make("passive", 0.0, 0.0);
    run(&mut world, passive.as_mut(), &RobotQ::zeros(6), 100);
    let expected = world.q().clone();
    let setpoint = Setpoint { q: &RobotQ::zeros(6), qd: &[0.0; 6], qdd: &[0.0; 6] };
    for torque in [1e60, 1e74, 1e200, f64::MAX] {
        for leave in
            [World::restore, |world: &mut World, _: &_| world.set_state(&arm_q0(), &[0.0; 6]).unwrap()]
        {
            let error = (0..200).find_map(|_| world.step(&mut Push(torque), &setpoint).err());
            assert!(matches!(error, Some(SimulationError::NotFinite { .. })), "{torque:e}: {error:?}");
            leave(&mut world, &before);
            run(&mut world, passive.as_mut(), &RobotQ::zeros(6), 100);
            assert_eq!(world.q(), &expected, "{torque:e}");
        }
    }
}
