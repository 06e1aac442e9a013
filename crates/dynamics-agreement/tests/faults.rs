//! The planted faults of the corpus: 71 changes of inertials and joints, with the torques that they change and the
//! explanations that leave the same torques.

#[path = "../../../tests/corpus.rs"]
mod corpus;

use std::{collections::BTreeMap, path::Path};

use congruent_description::{Robot, RobotQ, load_robot};
use congruent_dynamics::JointMotion;
use congruent_dynamics_agreement::{
    Description, DynamicsReport, Explanation, Inertial, Side, Verdict, compare,
};
use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::Value;

/// Rounding of two programs, relative to the largest torque of the state; worst seen 2e-14.
const RELATIVE: f64 = 1e-11;

fn read(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("the corpus holds the file");
    serde_json::from_str(&text).expect("the file is JSON")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a string")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|at| number(&value[at]))
}

fn array(value: &Value) -> &Vec<Value> {
    value.as_array().expect("an array")
}

fn names(value: &Value) -> Vec<&str> {
    array(value).iter().map(text).collect()
}

/// What a file would say.
fn inertial(value: &Value) -> Option<Inertial> {
    if value.is_null() {
        return None;
    }
    let [roll, pitch, yaw] = numbers(&value["rpy"]);
    let [xx, xy, xz, yy, yz, zz] = numbers(&value["inertia"]);
    Some(Inertial {
        mass_kg: number(&value["mass"]),
        com_m: Vector3::from(numbers::<3>(&value["xyz"])),
        link_from_axes: Rotation3::from_euler_angles(roll, pitch, yaw).into_inner(),
        tensor_kg_m2: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    })
}

/// A side with the changes of a fault.
fn mutated(robot: &Robot, fault: &Value) -> Side {
    let mut side = Side::new(robot);
    for (link, figures) in fault["changes"].as_object().expect("changes by link") {
        let link = side.frames().find_link(link).expect("a link of the robot");
        side.inertials[link] = inertial(figures);
    }
    for (joint, terms) in fault["joint_changes"].as_object().expect("changes by joint") {
        let joint = side.frames().find_joint(joint).expect("a joint of the robot");
        for (term, value) in terms.as_object().expect("terms") {
            let value = number(value);
            match term.as_str() {
                "damping" => side.resistances[joint].damping = value,
                "friction" => side.resistances[joint].friction = value,
                "velocity" => side.limits[joint].as_mut().expect("a limit").velocity = value,
                "effort" => side.limits[joint].as_mut().expect("a limit").effort = value,
                other => panic!("{other} is no term of a joint"),
            }
        }
    }
    side
}

/// For each fault the robot, the mutated side and the original.
fn each_fault(mut check: impl FnMut(&Value, &Side, &Side)) {
    let Some(corpus) = corpus::corpus() else { return };
    let golden = read(&corpus.join("dynamics-faults/faults.json"));
    let mut robots: BTreeMap<String, Robot> = BTreeMap::new();
    let faults = array(&golden["faults"]);
    assert_eq!(faults.len(), 71);
    for fault in faults {
        let name = text(&fault["robot"]);
        let robot = robots.entry(name.to_owned()).or_insert_with(|| {
            load_robot(&corpus.join("robots").join(name).join("robot.urdf")).unwrap_or_else(|findings| panic!("{findings:#?}")).robot
        });
        check(fault, &mutated(robot, fault), &Side::new(robot));
    }
}

fn compared(candidate: &Side, reference: &Side) -> DynamicsReport {
    let description = |name, side| Description { name, side, places: None };
    compare(&description("mutated", candidate), &description("original", reference), 1).expect("one chain")
}

/// All names of an explanation with their details and places.
fn all_names(explanation: &Explanation) -> Vec<(&str, &str, Vec<&str>)> {
    let place = |place: &'_ [String]| -> Vec<String> { place.to_vec() };
    let _ = place;
    let own = (explanation.cause.name(), explanation.detail.as_str(), refs(&explanation.place));
    let also = explanation.also_named.iter().map(|name| (name.cause.name(), name.detail.as_str(), refs(&name.place)));
    std::iter::once(own).chain(also).collect()
}

fn refs(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

#[test]
fn every_fault_is_named_or_listed() {
    let (mut named, mut listed) = (0, 0);
    let mut missed = Vec::new();
    each_fault(|fault, candidate, reference| {
        let id = text(&fault["id"]);
        let report = compared(candidate, reference);
        let is_seen = fault["seen_by_joint_torque"].as_bool().expect("yes or no");
        if !is_seen {
            assert!(report.explanations.is_empty(), "{id}: {:?}", report.explanations);
            return;
        }
        let (cause, place) = (text(&fault["cause"]), names(&fault["place"]));
        let is_planted = |explanation: &Explanation| {
            all_names(explanation).iter().any(|(name, _, at)| *name == cause && *at == place)
        };
        if report.explanations.iter().any(is_planted) {
            named += 1;
        } else if report.indistinguishable.iter().any(is_planted) {
            listed += 1;
            println!("{id} is listed; named is {:?}", report.explanations.iter().map(all_names).collect::<Vec<_>>());
        } else {
            missed.push(format!(
                "{id}: {:?} instead; {:?} {}",
                report.explanations.iter().map(all_names).collect::<Vec<_>>(),
                report.links,
                report.indistinguishable.len(),
            ));
        }
    });
    println!("{named} named, {listed} listed");
    assert!(missed.is_empty(), "{missed:#?}");
}
