//! Dynamics against numbers from independent programs: algorithms against Pinocchio, motion against `MuJoCo`.

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

use std::path::Path;

use congruent_description::{Robot, RobotQ, load_robot};
use congruent_dynamics::{BodyTree, DrivenState, JointMotionState, JointResistance, Rollout};
use nalgebra::{DMatrix, Vector3};
use serde_json::Value;

/// Rounding, ours and the other program's, relative to the largest value of the vector; worst seen 3.8e-14 (accelerations).
const RELATIVE: f64 = 1e-10;

const ROBOTS: [&str; 8] =
    ["baxter", "denso_hsr065", "iiwa14", "panda", "rrr_arm", "so100", "ur5e", "xarm7_gripper"];

/// How often the stated uncertainty of a reference motion is allowed.
const UNCERTAINTIES: f64 = 10.0;

/// Rounding of a position of up to 2 rad or m, where the file states no uncertainty at all.
const PRINTED: f64 = 4.0 * f64::EPSILON;

fn read(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("the corpus holds the file");
    serde_json::from_str(&text).expect("the file is JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    array(value).iter().map(|number| number.as_f64().expect("a number")).collect()
}

fn array(value: &Value) -> &Vec<Value> {
    value.as_array().expect("an array")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("a string")
}

fn load(path: &Path) -> Robot {
    load_robot(path).unwrap_or_else(|findings| panic!("{findings:#?}")).robot
}

/// For each joint of the robot its place among these names.
fn places(robot: &Robot, names: &[&str]) -> Vec<usize> {
    let place = |name: &str| names.iter().position(|known| *known == name).expect("both have the joint");
    robot.movable_joint_names().map(place).collect()
}

fn reordered(values: &[f64], places: &[usize]) -> Vec<f64> {
    places.iter().map(|&place| values[place]).collect()
}

#[track_caller]
fn assert_near(what: &str, found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    for (found, expected) in found.iter().zip(expected) {
        let relative = (found - expected).abs() / size.max(f64::MIN_POSITIVE);
        // A vector of zeros has no scale of its own.
        let error = if size > 1e-9 { relative } else { (found - expected).abs() };
        assert!(error < RELATIVE, "{what}: {found} for {expected}, {error:e}");
    }
}

struct Golden {
    robot: Robot,
    tree: BodyTree,
    places: Vec<usize>,
    configs: Vec<Value>,
}

fn golden(corpus: &Path, name: &str) -> Golden {
    let folder = corpus.join("robots").join(name);
    let golden = read(&folder.join("golden.json"));
    // Those of kind "axis" have poses alone.
    let configs = array(&golden["configs"]).iter().filter(|config| config["kind"] != "axis");
    assert_eq!(golden["dynamics_valid"], true, "{name}");
    let robot = load(&folder.join("robot.urdf"));
    let names: Vec<&str> = array(&golden["joints"]).iter().map(|joint| text(&joint["name"])).collect();
    let places = places(&robot, &names);
    let tree = BodyTree::new(&robot)
        .without_resistances()
        .with_gravity(Vector3::from_iterator(numbers(&golden["gravity"])));
    Golden { robot, tree, places, configs: configs.cloned().collect() }
}

impl Golden {
    fn vector(&self, values: &Value) -> Vec<f64> {
        reordered(&numbers(values), &self.places)
    }
}

#[test]
fn algorithms_agree_with_pinocchio() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ROBOTS {
        let golden = golden(&corpus, name);
        let (tree, n) = (&golden.tree, golden.tree.dof());
        let (mut buffer, mut tau, mut matrix) = (tree.buffer(), vec![0.0; n], DMatrix::zeros(n, n));
        let mut checked = 0;
        for config in &golden.configs {
            let [q, qd, qdd] = ["q", "v", "a"].map(|key| golden.vector(&config[key]));
            let q = RobotQ::from(q);
            tree.gravity_into(&q, &mut buffer, &mut tau).unwrap();
            assert_near(name, &tau, &golden.vector(&config["gravity_torque"]));
            tree.inverse_into(&JointMotionState { q: &q, qd: &qd, qdd: &qdd }, &mut buffer, &mut tau)
                .unwrap();
            assert_near(name, &tau, &golden.vector(&config["rnea"]));
            tree.mass_matrix_into(&q, &mut buffer, &mut matrix).unwrap();
            let rows = array(&config["mass_matrix"]);
            for (row, &place) in golden.places.iter().enumerate() {
                let found: Vec<f64> = matrix.row(row).iter().copied().collect();
                assert_near(name, &found, &golden.vector(&rows[place]));
            }
            let energy = tree.energy(&q, &qd).unwrap();
            let expected = ["kinetic_energy", "potential_energy"].map(|key| config[key].as_f64().unwrap());
            assert_near(name, &[energy.kinetic_j, energy.potential_j], &expected);
            checked += 1;
        }
        assert!(checked == 51, "{name} has configurations");
    }
}

#[test]
fn accelerations_agree_with_pinocchio() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ROBOTS {
        let golden = golden(&corpus, name);
        let (tree, n) = (&golden.tree, golden.tree.dof());
        let independent = tree.clone().with_independent_mimics();
        let (mut buffer, mut qdd, zeros) = (tree.buffer(), vec![0.0; n], vec![0.0; n]);
        for config in &golden.configs {
            let (q, qd) = (RobotQ::from(golden.vector(&config["q"])), golden.vector(&config["v"]));
            let state = DrivenState { q: &q, qd: &qd, tau: &zeros };
            independent.forward_into(&state, &mut buffer, &mut qdd).unwrap();
            assert_near(name, &qdd, &golden.vector(&config["aba_zero_torque"]));
            if golden.robot.joints().iter().any(|joint| joint.mimic.is_some()) {
                tree.forward_into(&state, &mut buffer, &mut qdd).unwrap();
                assert_near(name, &qdd, &golden.vector(&config["aba_zero_torque_mimic"]));
            }
        }
    }
}

/// Step of our integration and of the reference's.
const STEP_S: f64 = 1e-4;

/// Every case within the first half second; damped ones to their end.
#[test]
fn motion_agrees_with_mujoco() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ["denso_hsr065", "iiwa14", "panda", "rrr_arm", "ur5e"] {
        let folder = corpus.join("robots").join(name);
        let reference = read(&folder.join("trajectories.json"));
        let robot = load(&folder.join(text(&reference["urdf"])));
        let names: Vec<&str> = array(&reference["joints"]).iter().map(text).collect();
        let places = places(&robot, &names);
        for case in array(&reference["cases"]) {
            assert_case(name, &robot, case, &places);
        }
    }
}

#[track_caller]
fn assert_case(name: &str, robot: &Robot, case: &Value, places: &[usize]) {
    let vector = |value: &Value| reordered(&numbers(value), places);
    let resistance = |damping| JointResistance { damping, ..JointResistance::default() };
    let resistances = vector(&case["damping"]).into_iter().map(resistance).collect();
    let tree = BodyTree::new(robot).with_resistances(resistances).expect("one for each joint");
    let torque = vector(&case["torque"]);
    let mut rollout = Rollout::new(&tree, RobotQ::from(vector(&case["q0"])), vector(&case["v0"]))
        .expect("one value for each joint");
    let last_s = if text(&case["case"]) == "passive_damped" { f64::INFINITY } else { 0.5 };
    let (uncertainty, times) = (numbers(&case["reference_uncertainty"]), numbers(&case["t"]));
    // Two references that cross are no surer of it: the largest uncertainty so far counts.
    let mut stated = 0.0_f64;
    for (sample, q) in array(&case["q"]).iter().enumerate().filter(|(sample, _)| times[*sample] <= last_s) {
        stated = stated.max(uncertainty[sample]);
        while rollout.state().time_s < times[sample] - STEP_S / 2.0 {
            rollout
                .step(STEP_S, |_, _, _, tau| tau.copy_from_slice(&torque))
                .expect("every joint has inertia");
        }
        let found = &rollout.state().q;
        let error = found.iter().zip(vector(q)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let limit = UNCERTAINTIES * stated + PRINTED;
        assert!(
            error <= limit,
            "{name} {}: {error:e} at {} s, at most {limit:e}",
            case["case"],
            times[sample]
        );
    }
}

/// The numbers of base parameters among the `10 n` inertial parameters, by an independent program.
#[test]
fn as_many_base_parameters_as_known() {
    let Some(corpus) = corpus::corpus() else { return };
    for (name, expected) in [
        ("ur5e", 36),
        ("iiwa14", 43),
        ("panda", 51),
        ("rrr_arm", 30),
        ("denso_hsr065", 8),
        ("xarm7_gripper", 85),
    ] {
        let golden = golden(&corpus, name);
        let vectors: Vec<[Vec<f64>; 3]> = golden
            .configs
            .iter()
            .map(|config| ["q", "v", "a"].map(|key| golden.vector(&config[key])))
            .collect();
        let positions: Vec<RobotQ> = vectors.iter().map(|[q, ..]| RobotQ::from(q.clone())).collect();
        let motions: Vec<JointMotionState<'_>> =
            vectors.iter().zip(&positions).map(|([_, qd, qdd], q)| JointMotionState { q, qd, qdd }).collect();
        let base = golden.tree.clone().with_independent_mimics().base_parameters(&motions).unwrap();
        assert_eq!(base.groups.len(), expected, "{name}");
    }
}
