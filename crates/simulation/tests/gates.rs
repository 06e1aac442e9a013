//! The gates on the corpus of real robots, against numbers from Pinocchio and `MuJoCo`. Numbers (a01
//! and so on) are those of the table of gates; the part that needs no golden file is `arms/`.

#![expect(clippy::print_stdout, reason = "the worst values, for those who run with --nocapture")]

#[path = "../../../tests/support/corpus.rs"]
mod corpus;
mod support;

use std::path::Path;

use congruent_description::{Joint, Robot, RobotQ, load_robot};
use congruent_simulation::{Torque, World, WorldSettings};
use nalgebra::{DMatrix, DVector, Isometry3, Quaternion, UnitQuaternion};
use serde_json::Value;
use support::{at, bits, make, rebuilt, run, steps, with_step, worst};

const ROBOTS: [&str; 9] =
    ["baxter", "denso_hsr065", "fanuc_m10ia", "iiwa14", "panda", "rrr_arm", "so100", "ur5e", "xarm7_gripper"];

/// A robot of the corpus with its golden file.
struct Golden {
    robot: Robot,
    file: Value,
    /// For each coordinate, its place in the golden vectors.
    order: Vec<usize>,
}

impl Golden {
    fn load(folder: &Path) -> Self {
        let description = load_robot(&folder.join("robot.urdf"));
        let robot =
            description.unwrap_or_else(|findings| panic!("{}: {findings:#?}", folder.display())).robot;
        let text = std::fs::read_to_string(folder.join("golden.json")).expect("the golden file is there");
        let file: Value = serde_json::from_str(&text).expect("the golden file is JSON");
        let order = order(&robot, file["joints"].as_array().expect("joints"), |joint| &joint["name"]);
        Self { robot, file, order }
    }

    fn configs(&self) -> impl Iterator<Item = &Value> {
        self.file["configs"].as_array().expect("configs").iter()
    }

    /// Those configurations that have velocities and dynamics.
    fn random(&self) -> impl Iterator<Item = &Value> {
        self.configs().filter(|config| config["kind"] == "random")
    }

    /// A golden vector in the order of coordinates.
    fn vector(&self, values: &Value) -> Vec<f64> {
        let values = numbers(values);
        self.order.iter().map(|&at| values[at]).collect()
    }

    /// The positions of a configuration.
    fn q(&self, config: &Value) -> RobotQ {
        self.vector(&config["q"]).into()
    }

    fn matrix(&self, rows: &Value) -> DMatrix<f64> {
        let rows: Vec<Vec<f64>> = rows.as_array().expect("rows").iter().map(numbers).collect();
        let dof = self.order.len();
        DMatrix::from_fn(dof, dof, |row, column| rows[self.order[row]][self.order[column]])
    }
}

fn order<'a>(robot: &Robot, known: &'a [Value], name: impl Fn(&'a Value) -> &'a Value) -> Vec<usize> {
    let find = |joint: &Joint| known.iter().position(|entry| name(entry) == joint.name.as_str());
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint));
    joints
        .map(|joint| find(joint).unwrap_or_else(|| panic!("{} is not in the golden file", joint.name)))
        .collect()
}

fn numbers(values: &Value) -> Vec<f64> {
    values.as_array().expect("an array").iter().map(|value| value.as_f64().expect("a number")).collect()
}

/// The folder with one folder for each robot.
fn robots() -> Option<std::path::PathBuf> {
    corpus::corpus().map(|corpus| corpus.join("robots"))
}

/// Every robot of the corpus; none if this run has no corpus.
fn goldens() -> Vec<(&'static str, Golden)> {
    let Some(corpus) = robots() else { return Vec::new() };
    ROBOTS.iter().map(|name| (*name, Golden::load(&corpus.join(name)))).collect()
}

/// What Pinocchio and `MuJoCo` computed: nothing but inertia and gravity.
fn frictionless(robot: &Robot) -> Robot {
    changed(robot, |joint| (joint.damping, joint.friction, joint.limit) = (0.0, 0.0, None))
}

/// The robot with each joint changed and no joint that mimics another.
fn changed(robot: &Robot, change: impl Fn(&mut Joint)) -> Robot {
    rebuilt(robot, |parts| change(&mut parts.joint))
}

/// Origin of a link, m, and entries of its quaternion; rounding of up to 20 products of about 1 m
/// and 17 digits of the golden; worst seen 2.4e-15 (baxter).
const POSE: f64 = 1e-12;

#[test]
fn a01_link_poses() {
    for (name, golden) in goldens() {
        let mut world = World::new(&golden.robot, &WorldSettings::default()).expect("a robot");
        let mut poses = vec![Isometry3::identity(); golden.robot.links().len()];
        let links = golden.file["links"].as_array().expect("links");
        let (mut metres, mut quaternions) = (0.0_f64, 0.0_f64);
        for config in golden.configs() {
            let q = golden.q(config);
            world.set_state(&q, &vec![0.0; q.len()]).expect("a state");
            assert_eq!(world.q(), &q);
            world.root_from_links_into(&mut poses);
            for (link, expected) in links.iter().zip(config["poses"].as_array().expect("poses")) {
                let link = golden.robot.find_link(link.as_str().expect("a name")).expect("a link");
                let expected = numbers(expected);
                let pose = poses[link.get()];
                metres = metres.max(worst(pose.translation.vector.as_slice(), &expected[..3]));
                quaternions = quaternions.max(quaternion_error(&pose.rotation, &expected[3..]));
            }
        }
        println!("a01 {name}: {metres:e} m, {quaternions:e}");
        assert!(metres < POSE && quaternions < POSE, "{name}: {metres:e} m, {quaternions:e}");
    }
}

/// Largest difference of the entries, of the nearer of the two signs.
fn quaternion_error(rotation: &UnitQuaternion<f64>, wxyz: &[f64]) -> f64 {
    let expected = Quaternion::new(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    let found = rotation.into_inner();
    (found.coords - expected.coords).amax().min((found.coords + expected.coords).amax())
}

/// Part of the matrix's or vector's largest entry; rounding; worst seen 1e-14 (panda).
const DYNAMICS_RELATIVE: f64 = 1e-11;

#[test]
fn a02_mass_matrix() {
    for (name, golden) in goldens().into_iter().filter(|(_, golden)| has_dynamics(golden)) {
        let mut world = World::new(&golden.robot, &WorldSettings::default()).expect("a robot");
        let mut off = 0.0_f64;
        for config in golden.random() {
            let q = golden.q(config);
            world.set_state(&q, &q).expect("velocities must not matter");
            let expected = golden.matrix(&config["mass_matrix"]);
            off = off.max((world.mass_matrix() - &expected).amax() / expected.amax());
        }
        println!("a02 {name}: {off:e}");
        assert!(off < DYNAMICS_RELATIVE, "{name}: {off:e}");
    }
}

fn has_dynamics(golden: &Golden) -> bool {
    golden.file["dynamics_valid"] == true
}

#[test]
fn a03_gravity_torque() {
    for (name, golden) in goldens().into_iter().filter(|(_, golden)| has_dynamics(golden)) {
        let mut world = World::new(&golden.robot, &WorldSettings::default()).expect("a robot");
        let all = || golden.random().map(|config| golden.vector(&config["gravity_torque"]));
        let largest = all().flatten().fold(0.0_f64, |largest, torque| largest.max(torque.abs()));
        let mut off = 0.0_f64;
        for (config, expected) in golden.random().zip(all()) {
            let q = golden.q(config);
            world.set_state(&q, &vec![0.0; q.len()]).expect("a state");
            off = off.max(worst(world.gravity_torque().as_slice(), &expected) / largest);
        }
        println!("a03 {name}: {off:e} of {largest} N m");
        assert!(off < DYNAMICS_RELATIVE, "{name}: {off:e}");
    }
}

/// One-step acceleration against ABA, part of the largest entry, h = 1 us; truncation, first
/// order in h, which the second half of the test shows; worst seen 4.7e-6 (UR5e), 3.7e-6 (Panda).
const ACCELERATION_RELATIVE: f64 = 1e-5;
/// The same of light arms whose goldens are fast; worst seen 3.0e-5 (`rrr_arm`).
const FAST_ACCELERATION_RELATIVE: f64 = 1e-4;

#[test]
fn a04_one_step_acceleration() {
    for (name, golden) in goldens().into_iter().filter(|(_, golden)| has_dynamics(golden)) {
        let robot = frictionless(&golden.robot);
        let off = [1e-6, 5e-7].map(|step_s| {
            let mut world = World::new(&robot, &with_step(step_s)).expect("a robot");
            golden.random().map(|config| one_step_error(&golden, config, &mut world)).fold(0.0, f64::max)
        });
        println!("a04 {name}: {off:?}");
        let is_gated = ["ur5e", "panda"].contains(&name);
        let limit = if is_gated { ACCELERATION_RELATIVE } else { FAST_ACCELERATION_RELATIVE };
        assert!(off[0] < limit, "{name}: {off:?}");
        assert!((1.8..2.2).contains(&(off[0] / off[1])), "{name}: first order, {off:?}");
    }
}

fn one_step_error(golden: &Golden, config: &Value, world: &mut World) -> f64 {
    let (q, qd) = (golden.q(config), golden.vector(&config["v"]));
    let step_s = world.time_s();
    world.set_state(&q, &qd).expect("a state");
    run(world, make("passive", 0.0, 0.0).as_mut(), &q, 1);
    let step_s = world.time_s() - step_s;
    let expected = DVector::from_vec(golden.vector(&config["aba_zero_torque"]));
    let found = (DVector::from_row_slice(world.qd()) - DVector::from_vec(qd)) / step_s;
    (found - &expected).amax() / expected.amax()
}

/// Ratio of the errors at h and h/2; physics, first order.
const FIRST_ORDER: std::ops::Range<f64> = 1.9..2.1;

/// Against `MuJoCo`'s RK4: halving the step halves the error, after 0.3 s (undamped arms amplify
/// errors, so the second-order part would show later).
#[test]
fn a05_motion_converges_to_mujoco() {
    let Some(corpus) = robots() else { return };
    for name in ["denso_hsr065", "iiwa14", "ur5e"] {
        let golden = Golden::load(&corpus.join(name));
        let text =
            std::fs::read_to_string(corpus.join(name).join("trajectories.json")).expect("trajectories");
        let file: Value = serde_json::from_str(&text).expect("JSON");
        let places = order(&golden.robot, file["joints"].as_array().expect("joints"), |joint| joint);
        for case in file["cases"].as_array().expect("cases") {
            let errors =
                [5e-4, 2.5e-4, 1.25e-4].map(|step_s| motion_error(&golden.robot, case, &places, step_s));
            println!("a05 {name} {}: {errors:?}", case["case"]);
            for pair in errors.windows(2) {
                // A fall without rotation is off by g h t / 2, free of second-order parts.
                assert!(FIRST_ORDER.contains(&(pair[0] / pair[1])), "{name} {}: {errors:?}", case["case"]);
            }
        }
    }
}

fn motion_error(robot: &Robot, case: &Value, places: &[usize], step_s: f64) -> f64 {
    let sorted = |values: &Value| {
        let values = numbers(values);
        places.iter().map(|&at| values[at]).collect::<Vec<f64>>()
    };
    let damping = sorted(&case["damping"]);
    let bare = frictionless(robot);
    let damped = changed(&bare, |joint| {
        let coordinate = robot.find_joint(&joint.name).and_then(|index| robot.coordinate(index));
        joint.damping = coordinate.map_or(0.0, |coordinate| damping[coordinate]);
    });
    let mut world = World::new(&damped, &with_step(step_s)).expect("a robot");
    let q0 = sorted(&case["q0"]).into();
    world.set_state(&q0, &sorted(&case["v0"])).expect("a state");
    let (sample, at_s) = (30, 0.3);
    run(&mut world, &mut Torque(sorted(&case["torque"])), &q0, steps(at_s, step_s));
    worst(world.q(), &sorted(&case["q"][sample]))
}

/// Drift under gravity compensation, rad or m in 10 s; rounding of g(q), an equilibrium that is
/// not stable; worst seen 2.0e-11 (panda).
const DRIFT: f64 = 1e-9;

/// Without effort limits, which in some descriptions are below what gravity asks for.
#[test]
fn a07_gravity_compensation() {
    for (name, golden) in goldens().into_iter().filter(|(_, golden)| has_dynamics(golden)) {
        let robot = changed(&golden.robot, |joint| {
            if let Some(limit) = &mut joint.limit {
                limit.effort = Some(0.0);
            }
        });
        let config = golden.random().next().expect("a random configuration");
        let q0 = golden.q(config);
        let mut world = at(&robot, &WorldSettings::default(), &q0);
        run(&mut world, make("gravity_compensation", 0.0, 0.0).as_mut(), &q0, 10_000);
        println!("a07 {name}: {:e}", worst(world.q(), &q0));
        assert!(worst(world.q(), &q0) < DRIFT, "{name}: {:e}", worst(world.q(), &q0));
    }
}

/// Error of `q = multiplier * master + offset`, rad or m; rounding and solver stop; worst seen
/// 1.9e-13 (`xarm7_gripper`, five followers of one master).
const COUPLING: f64 = 1e-12;

#[test]
fn a11_mimic_joints() {
    for (name, golden) in goldens() {
        let robot = &golden.robot;
        if !has_dynamics(&golden) || robot.joints().iter().all(|joint| joint.mimic.is_none()) {
            continue;
        }
        let config = golden.random().next().expect("a random configuration");
        let mut q0 = golden.q(config);
        robot.apply_mimic(&mut q0);
        let target = RobotQ::from(vec![0.02; q0.len()]);
        for (kind, stiffness, damping) in [("passive", 0.0, 0.0), ("pd", 200.0, 20.0)] {
            let mut world = at(robot, &WorldSettings::default(), &q0);
            let mut controller = make(kind, stiffness, damping);
            let mut off = 0.0_f64;
            for _ in 0..3000 {
                run(&mut world, controller.as_mut(), &target, 1);
                let mut expected = world.q().clone();
                robot.apply_mimic(&mut expected);
                off = off.max(worst(world.q(), &expected));
            }
            println!("a11 {name} {kind}: {off:e}");
            assert!(off < COUPLING, "{name} {kind}: {off:e}");
        }
    }
}

#[test]
fn a13_repeated_and_restored_runs_are_equal_bit_by_bit() {
    for (name, golden) in goldens().into_iter().filter(|(_, golden)| has_dynamics(golden)) {
        let start = golden.random().next().expect("a random configuration");
        let (q0, target) = (golden.q(start), RobotQ::from(vec![0.1; golden.order.len()]));
        let begin = || at(&golden.robot, &WorldSettings::default(), &q0);
        for kind in ["passive", "pd", "gravity_compensation"] {
            let mut controller = make(kind, 100.0, 10.0);
            let mut first = begin();
            run(&mut first, controller.as_mut(), &target, 300);
            let snapshot = first.snapshot();
            run(&mut first, controller.as_mut(), &target, 300);
            let mut second = begin();
            run(&mut second, controller.as_mut(), &target, 600);
            assert_eq!(bits(&first), bits(&second), "{name} {kind}: repeated");
            second.restore(&snapshot);
            run(&mut second, controller.as_mut(), &target, 300);
            assert_eq!(bits(&first), bits(&second), "{name} {kind}: restored");
        }
    }
}
