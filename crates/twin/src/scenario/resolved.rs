//! A scenario written back as TOML, with every default spelt out.

use std::path::Path;

use congruent_description::{Geometry, JointKind, Robot};
use congruent_simulation::Obstacle;
use nalgebra::Isometry3;
use toml::{Table, Value};

use super::{Scenario, Zone};
use crate::{
    motion::{Course, Motion},
    verdict::Expectation,
};

pub(super) fn toml(scenario: &Scenario) -> String {
    let robot = &scenario.description.robot;
    let seed = i64::try_from(scenario.seed).expect("seeds of scenarios fit into TOML");
    let mut top = table([
        ("schema_version", Value::Integer(1)),
        ("name", scenario.name.as_str().into()),
        ("robot", robot_path(&scenario.description.path).into()),
        ("seed", Value::Integer(seed)),
    ]);
    let simulation = &scenario.simulation;
    insert(
        &mut top,
        "simulation",
        [
            ("step_s", simulation.step_s.into()),
            ("duration_s", simulation.duration_s().into()),
            ("gravity_m_s2", numbers(simulation.gravity_in_world.as_slice())),
        ],
    );
    top.insert("start".to_owned(), joints("joints", robot, &scenario.start).into());
    let controller = &scenario.controller;
    insert(
        &mut top,
        "controller",
        [
            ("kind", controller.kind.as_str().into()),
            ("stiffness", controller.gains.stiffness.into()),
            ("damping", controller.gains.damping.into()),
        ],
    );
    let motions = scenario.trajectory.motions().iter().map(|step| motion(robot, step));
    top.insert("motion".to_owned(), Value::Array(motions.collect()));
    let obstacles = scenario.obstacles.iter().map(|each| Value::Table(standing(each)));
    top.insert("obstacle".to_owned(), Value::Array(obstacles.collect()));
    top.insert(
        "zone".to_owned(),
        Value::Array(scenario.zones.iter().map(|each| zone(robot, each)).collect()),
    );
    let checks = scenario.checks.iter().map(|check| {
        let mut section =
            table([("kind", check.kind.into()), ("on_violation", check.on_violation.name().into())]);
        section.extend(check.monitor.resolved());
        Value::Table(section)
    });
    top.insert("check".to_owned(), Value::Array(checks.collect()));
    top.insert("expect".to_owned(), expectation(&scenario.expect));
    top.to_string()
}

fn table<const N: usize>(entries: [(&str, Value); N]) -> Table {
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn insert<const N: usize>(top: &mut Table, key: &str, entries: [(&str, Value); N]) {
    top.insert(key.to_owned(), table(entries).into());
}

fn numbers(values: &[f64]) -> Value {
    Value::Array(values.iter().map(|&value| value.into()).collect())
}

/// The robot's file without links and `..`.
fn robot_path(path: &Path) -> String {
    let whole = path.canonicalize().or_else(|_| std::path::absolute(path));
    whole.unwrap_or_else(|_| path.to_owned()).display().to_string()
}

/// Positions of all joints that follow no other, by name, in radians and metres.
fn joints(prefix: &str, robot: &Robot, q: &[f64]) -> Table {
    let (mut angles, mut shifts) = (Table::new(), Table::new());
    for (&joint, &value) in robot.movable_joints().iter().zip(q) {
        let joint = robot.joint(joint);
        if joint.mimic.is_none() {
            let group = if joint.kind == JointKind::Prismatic { &mut shifts } else { &mut angles };
            group.insert(joint.name.clone(), value.into());
        }
    }
    [("rad", angles), ("m", shifts)]
        .into_iter()
        .filter(|(_, group)| !group.is_empty())
        .map(|(unit, group)| (format!("{prefix}_{unit}"), Value::Table(group)))
        .collect()
}

fn motion(robot: &Robot, motion: &Motion) -> Value {
    let (mut section, settings) = match &motion.course {
        Course::Joints(course) => {
            let profile = ("profile", course.profile.name().into());
            (joints("move_joints", robot, &course.to), table([profile]))
        }
        Course::Servo(servo) => (
            table([("servo_tcp", servo.written.to_table().into())]),
            table([("method", servo.method.name().into()), ("gain_per_s", servo.gain_per_s.into())]),
        ),
    };
    section.insert("duration_s".to_owned(), motion.duration_s.into());
    section.extend(settings);
    Value::Table(section)
}

/// A zone, its links by their names.
fn zone(robot: &Robot, zone: &Zone) -> Value {
    let mut section = standing(&zone.space);
    let links = zone.links.iter().map(|&link| robot.link(link).name.as_str().into());
    section.insert("links".to_owned(), Value::Array(links.collect()));
    Value::Table(section)
}

/// Name, shape and place of what stands still.
fn standing(obstacle: &Obstacle) -> Table {
    let mut section = table([("name", obstacle.name.as_str().into())]);
    let (key, shape) = match &obstacle.geometry {
        Geometry::Box { size_m } => ("box_m", numbers(size_m.as_slice())),
        Geometry::Sphere { radius_m } => ("sphere_radius_m", (*radius_m).into()),
        Geometry::Cylinder { radius_m, length_m } => (
            "cylinder",
            Value::Table(table([("radius_m", (*radius_m).into()), ("length_m", (*length_m).into())])),
        ),
        Geometry::Mesh(_) => unreachable!("scenarios have no meshes of their own"),
    };
    section.insert(key.to_owned(), shape);
    let Isometry3 { rotation, translation } = obstacle.world_from_obstacle;
    let (roll, pitch, yaw) = rotation.euler_angles();
    section.insert("xyz_m".to_owned(), numbers(translation.vector.as_slice()));
    section.insert("rpy_rad".to_owned(), numbers(&[roll, pitch, yaw]));
    section
}

fn expectation(expect: &Expectation) -> Value {
    Value::Table(match expect {
        Expectation::Pass => table([("verdict", "pass".into())]),
        Expectation::Fail { checks } => table([
            ("verdict", "fail".into()),
            ("checks", Value::Array(checks.iter().map(|kind| kind.as_str().into()).collect())),
        ]),
    })
}
