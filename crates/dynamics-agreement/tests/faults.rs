//! The planted faults of the corpus: 71 changes of inertials and joints, with the torques that they change and the
//! explanations that give the same torques.

#![expect(clippy::print_stdout, reason = "measured values, for --nocapture")]

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use std::{collections::BTreeMap, path::Path};

use congruent_description::{Robot, RobotQ, load_robot};
use congruent_dynamics::{BodyTree, JointMotionState};
use congruent_dynamics_agreement::{
    DynamicsExplanation, DynamicsModel, DynamicsReport, DynamicsVerdict, Inertial, NamedModel,
    TorqueCertificate, TorqueCertificates, certify, compare,
};
use nalgebra::{Matrix3, Rotation3, Vector3};
use serde_json::Value;

/// Rounding of two programs, relative to the largest torque of the state or, where the fault itself is larger, to the
/// fault. The golden's frames were turned by angles of 16 digits. Worst seen: see the test's output.
const RELATIVE: f64 = 1e-11;

/// Attained differences come from local searches: both programs find the same maximum within this share.
const LOCAL_SEARCH: f64 = 1e-6;

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
fn mutated(robot: &Robot, fault: &Value) -> DynamicsModel {
    let mut model = DynamicsModel::new(robot);
    for (link, parameters) in fault["changes"].as_object().expect("changes by link") {
        let link = model.frames().find_link(link).expect("a link of the robot");
        model.inertials[link] = inertial(parameters);
    }
    for (joint, terms) in fault["joint_changes"].as_object().expect("changes by joint") {
        let joint = model.frames().find_joint(joint).expect("a joint of the robot");
        for (term, value) in terms.as_object().expect("terms") {
            let value = number(value);
            match term.as_str() {
                "damping" => model.resistances[joint].damping = value,
                "friction" => model.resistances[joint].friction = value,
                "velocity" => model.limits[joint].as_mut().expect("a limit").velocity = Some(value),
                "effort" => model.limits[joint].as_mut().expect("a limit").effort = Some(value),
                other => panic!("{other} is no term of a joint"),
            }
        }
    }
    model
}

/// For each fault the robot, the mutated side and the original.
fn each_fault(mut check: impl FnMut(&Value, &DynamicsModel, &DynamicsModel)) {
    let Some(corpus) = corpus::corpus() else { return };
    let golden = read(&corpus.join("dynamics-faults/faults.json"));
    let mut robots: BTreeMap<String, Robot> = BTreeMap::new();
    let faults = array(&golden["faults"]);
    assert_eq!(faults.len(), 71);
    for fault in faults {
        let name = text(&fault["robot"]);
        let robot = robots.entry(name.to_owned()).or_insert_with(|| {
            load_robot(&corpus.join("robots").join(name).join("robot.urdf"))
                .unwrap_or_else(|findings| panic!("{findings:#?}"))
                .robot
        });
        check(fault, &mutated(robot, fault), &DynamicsModel::new(robot));
    }
}

fn compared(candidate: &DynamicsModel, reference: &DynamicsModel) -> DynamicsReport {
    let description = |name, model| NamedModel { name, model, places: None };
    compare(&description("mutated", candidate), &description("original", reference), 1).expect("one chain")
}

fn brackets_of(candidate: &DynamicsModel, reference: &DynamicsModel) -> TorqueCertificates {
    let description = |name, model| NamedModel { name, model, places: None };
    certify(&description("mutated", candidate), &description("original", reference), 1).expect("one chain")
}

/// All names of an explanation with their details and places.
fn all_names(explanation: &DynamicsExplanation) -> Vec<(&str, &str, Vec<&str>)> {
    let own = (explanation.cause.name(), explanation.detail.as_str(), refs(&explanation.place));
    let also = explanation
        .also_named
        .iter()
        .map(|name| (name.cause.name(), name.detail.as_str(), refs(&name.place)));
    std::iter::once(own).chain(also).collect()
}

fn refs(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

/// Of several places those with the largest effect come first in a report.
fn sorted(mut place: Vec<&str>) -> Vec<&str> {
    place.sort_unstable();
    place
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
        let (cause, place) = (text(&fault["cause"]), sorted(names(&fault["place"])));
        let is_planted = |explanation: &DynamicsExplanation| {
            let names = all_names(explanation);
            names.iter().any(|(name, _, at)| *name == cause && sorted(at.clone()) == place)
        };
        if report.explanations.iter().any(is_planted) {
            named += 1;
        } else if report.indistinguishable.iter().any(is_planted) {
            listed += 1;
            println!(
                "{id} is listed; named is {:?}",
                report.explanations.iter().map(all_names).collect::<Vec<_>>()
            );
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

/// Values by name in the order of the robot's joints.
fn by_joint(model: &DynamicsModel, values: &Value) -> Vec<f64> {
    (0..model.frames().dof()).map(|joint| number(&values[model.frames().joint_name(joint)])).collect()
}

#[derive(Clone, Copy)]
struct At<'a> {
    q: &'a RobotQ,
    qd: &'a [f64],
    qdd: &'a [f64],
}

fn torque(tree: &BodyTree, at: At<'_>) -> Vec<f64> {
    let mut tau = vec![0.0; tree.dof()];
    let motion = JointMotionState { q: at.q, qd: at.qd, qdd: at.qdd };
    tree.inverse_into(&motion, &mut tree.buffer(), &mut tau).expect("the robot's own state");
    tau
}

#[test]
fn torques_differ_by_what_another_program_says() {
    let mut worst = 0.0_f64;
    each_fault(|fault, candidate, reference| {
        let trees = [candidate.tree(), reference.tree()];
        for state in fault["states"].as_array().expect("states") {
            let [q, qd, qdd] = ["q", "v", "a"].map(|name| by_joint(candidate, &state[name]));
            let (q, zeros) = (RobotQ::from(q), vec![0.0; qd.len()]);
            let moving = At { q: &q, qd: &qd, qdd: &qdd };
            let still = At { q: &q, qd: &zeros, qdd: &zeros };
            let rigid = trees.clone().map(BodyTree::without_resistances);
            let difference = |trees: &[BodyTree; 2], at: At<'_>| -> (Vec<f64>, f64) {
                let [found, expected] = [torque(&trees[0], at), torque(&trees[1], at)];
                let size = found.iter().chain(&expected).fold(0.0_f64, |size, tau| size.max(tau.abs()));
                (found.iter().zip(&expected).map(|(a, b)| a - b).collect(), size)
            };
            let (whole, size) = difference(&trees, moving);
            let (bodies, _) = difference(&rigid, moving);
            let terms: Vec<f64> = whole.iter().zip(&bodies).map(|(whole, bodies)| whole - bodies).collect();
            let checks = [
                (bodies, "inverse_dynamics_difference"),
                (terms, "joint_terms_difference"),
                (difference(&trees, still).0, "gravity_difference"),
            ];
            for (found, name) in checks {
                for (found, expected) in found.iter().zip(by_joint(candidate, &state[name])) {
                    let error = (found - expected).abs() / size;
                    worst = worst.max(error);
                    assert!(error < RELATIVE, "{}: {name} {found} for {expected}", fault["id"]);
                }
            }
        }
    });
    println!("worst relative error {worst:e}");
}

/// Two local searches of a sum of absolute values find the same maximum within this share.
const LOCAL_SEARCH_SUM: f64 = 0.02;

/// Of the report's inertia brackets; the golden's is 1.
const ACCELERATION: f64 = 10.0;

#[derive(Debug)]
struct Brackets {
    count: usize,
    /// As tight as the golden or tighter.
    tight: usize,
    loosest: f64,
}

impl Brackets {
    const NONE: Self = Self { count: 0, tight: 0, loosest: 1.0 };

    /// Compares a bracket, `[attained, certified]`, with that of the other program.
    fn check(&mut self, what: &str, [low, high]: [f64; 2], golden: [f64; 2]) {
        let [attained, certified] = golden;
        assert!(high >= low, "{what}: {low} to {high}");
        assert!(high >= attained * (1.0 - RELATIVE), "{what}: {low} to {high}, {attained} is attained");
        assert!(low <= certified * (1.0 + RELATIVE), "{what}: {low} to {high}, {certified} is certified");
        self.count += 1;
        self.tight += usize::from(high <= certified * 1.01);
        self.loosest = self.loosest.max(high / low);
        if high > low * 1.06 {
            println!("{what}: {:.3}, golden {:.3}", high / low, certified / attained);
        }
    }
}

fn attained_and_certified(golden: &Value) -> [f64; 2] {
    ["attained", "certified"].map(|key| number(&golden[key]))
}

/// The other program moves the joints of a gripper one by one. Here they follow the first of them, so values attained with
/// independent fingers are not comparable.
fn fingers_are_together(q: &Value) -> bool {
    let joints = q.as_object().into_iter().flatten();
    let mut positions = joints.filter(|(name, _)| is_of_gripper(name)).map(|(_, position)| position);
    let first = positions.next();
    positions.all(|position| Some(position) == first)
}

/// A joint that others follow, or that follows: its torque is that of all of them.
fn is_of_gripper(joint: &str) -> bool {
    ["finger", "knuckle", "drive_joint"].iter().any(|part| joint.contains(part))
}

fn check_gravity(
    fault: &Value,
    [candidate, reference]: [&DynamicsModel; 2],
    found: &TorqueCertificate,
    brackets: &mut Brackets,
) {
    let id = text(&fault["id"]);
    let golden = fault["gravity_n_m"]["by_joint"].as_object().expect("joints");
    for (joint, golden) in golden.iter().filter(|(joint, _)| !is_of_gripper(joint)) {
        let is_possible = fingers_are_together(&golden["q"]);
        let golden = attained_and_certified(golden);
        let bracket = found.by_joint.iter().find(|bracket| bracket.joint == *joint);
        let Some(bracket) = bracket else { panic!("{id}: nothing at {joint}, expected {golden:?}") };
        brackets.check(&format!("{id} {joint}"), [bracket.attained_n_m, bracket.certified_n_m], golden);
        if is_possible {
            assert!(bracket.attained_n_m >= golden[0] * (1.0 - LOCAL_SEARCH), "{id} {joint}: {bracket:?}");
        }
        let at = RobotQ::from(bracket.q.clone());
        let zeros = vec![0.0; at.len()];
        let still = At { q: &at, qd: &zeros, qdd: &zeros };
        let place = candidate.frames().find_joint(joint).expect("a joint");
        let difference = torque(&candidate.tree(), still)[place] - torque(&reference.tree(), still)[place];
        let error = (difference.abs() - bracket.attained_n_m).abs();
        assert!(error <= 1e-9 * bracket.attained_n_m.max(1e-3), "{id} {joint}: {difference} {bracket:?}");
    }
    let is_unknown = |joint: &str| !golden.contains_key(joint) && !is_of_gripper(joint);
    for bracket in found.by_joint.iter().filter(|bracket| is_unknown(&bracket.joint)) {
        assert!(bracket.certified_n_m < 1e-6, "{id}: {bracket:?} is not in the golden");
    }
}

fn check_inertia(fault: &Value, found: &TorqueCertificate, brackets: &mut Brackets) {
    let (id, golden) = (text(&fault["id"]), &fault["mass_matrix_row"]);
    let Some(joint) = golden["joint"].as_str() else { return };
    if is_of_gripper(joint) {
        return;
    }
    let golden = attained_and_certified(golden);
    let Some(bracket) = found.by_joint.iter().find(|bracket| bracket.joint == joint) else {
        assert!(golden[0] < 1e-12, "{id}: nothing at {joint}, expected {golden:?}");
        return;
    };
    let [low, high] = [bracket.attained_n_m, bracket.certified_n_m].map(|value| value / ACCELERATION);
    brackets.check(&format!("{id} {joint}, row of inertia"), [low, high], golden);
    if bracket.boxes > 0 && fingers_are_together(&fault["mass_matrix_row"]["q"]) {
        assert!(low >= golden[0] * (1.0 - LOCAL_SEARCH_SUM), "{id} {joint}: {bracket:?} {golden:?}");
    }
}

#[test]
fn the_largest_differences_are_bracketed() {
    let (mut gravity, mut inertia) = (Brackets::NONE, Brackets::NONE);
    each_fault(|fault, candidate, reference| {
        let found = brackets_of(candidate, reference);
        check_gravity(fault, [candidate, reference], &found.gravity, &mut gravity);
        check_inertia(fault, &found.inertia, &mut inertia);
    });
    println!("gravity {gravity:?}, inertia {inertia:?}");
}

#[test]
fn no_alarm_without_a_fault() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ["ur5e", "iiwa14", "panda", "so100", "rrr_arm", "xarm7_gripper", "baxter", "denso_hsr065"] {
        let path = corpus.join("robots").join(name).join("robot.urdf");
        let robot = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot;
        let model = DynamicsModel::new(&robot);
        let report = compared(&model, &model);
        assert_eq!(report.verdict, DynamicsVerdict::Same, "{name}");
        assert!(report.explanations.is_empty() && report.hidden_differences.is_empty(), "{name}");
        let golden = &read(&corpus.join("dynamics-faults/faults.json"))["robots"][name];
        let seen = report.seen.expect("an arm of few joints");
        let seen = [seen.numbers, seen.numbers - seen.weak, seen.of];
        let expected =
            ["base_parameters", "clearly_seen", "inertial_parameters"].map(|key| golden[key].as_u64());
        assert_eq!(seen.map(|count| u64::try_from(count).ok()), expected, "{name}");
    }
}

#[test]
fn turned_inertial_frames_and_hidden_parameters_raise_no_alarm() {
    each_fault(|fault, candidate, reference| {
        let (id, cause) = (text(&fault["id"]), text(&fault["cause"]));
        let report = compared(candidate, reference);
        let place = names(&fault["place"]);
        match cause {
            "none" => assert_eq!(report.verdict, DynamicsVerdict::Same, "{id}: {:?}", report.differences),
            "hidden" | "transfer" => {
                assert_eq!(report.verdict, DynamicsVerdict::SameTorques, "{id}");
                let all_there =
                    report.hidden_differences.iter().all(|hidden| place.contains(&hidden.of.as_str()));
                assert!(!report.hidden_differences.is_empty() && all_there, "{id}: {report:?}");
            }
            "velocity_limit" | "effort_limit" => {
                let [limit] = &report.limits[..] else { panic!("{id}: {:?}", report.limits) };
                assert_eq!([limit.joint.as_str()], place[..], "{id}");
                assert_eq!(limit.detail == "degrees", text(&fault["detail"]) == "degrees", "{id}");
                assert_eq!(report.verdict, DynamicsVerdict::Same, "{id}");
            }
            _ => assert_eq!(report.verdict, DynamicsVerdict::Explained, "{id}"),
        }
    });
}
