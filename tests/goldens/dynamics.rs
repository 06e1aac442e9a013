//! `congruent dynamics` against Pinocchio: the equations of motion and the physics, every robot of the corpus that has
//! inertias.

use std::path::Path;

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::corpus,
    golden::{Golden, numbers},
};

const ROBOTS: [&str; 8] =
    ["baxter", "denso_hsr065", "iiwa14", "panda", "rrr_arm", "so100", "ur5e", "xarm7_gripper"];

/// Relative to the largest entry of a vector; rounding; worst seen 3.8e-14.
const MODEL: f64 = 1e-10;
/// Relative to the largest entry; extrapolation of the step of a scheme of first order; worst seen 1.5e-9.
const SIMULATION: f64 = 1e-7;

/// The golden's vector in the order of the report's joints.
fn reordered(golden: &Golden, joints: &Value, values: &Value) -> Vec<f64> {
    let (known, values) = (golden.joints(), numbers(values));
    let place = |joint: &Value| known.iter().position(|name| joint == name).unwrap();
    joints.as_array().unwrap().iter().map(|joint| values[place(joint)]).collect()
}

/// Largest difference of two vectors, relative to the largest entry of the second.
fn relative(found: &[f64], expected: &[f64]) -> f64 {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, value| most.max(value.abs()));
    let size = largest(&mut expected.iter().copied()).max(1e-6);
    largest(&mut found.iter().zip(expected).map(|(found, expected)| found - expected)) / size
}

/// The worst relative difference of a source from the golden, which counts each joint as driven.
pub(super) fn worst(urdf: &str, batch: &str, golden: &Golden, source: &str) -> f64 {
    let arguments = ["dynamics", urdf, "--configurations", batch, "--source", source, "--free-followers"];
    let answer = congruent_json(&arguments);
    assert_eq!(answer.code, 0, "{urdf}: {}", answer.stderr);
    let report = answer.json();
    let joints = &report["joints"];
    let mut worst = 0.0_f64;
    for (found, expected) in
        report["results"].as_array().unwrap().iter().zip(golden.configurations(&["zero", "random"]))
    {
        let mut hold = |found: &Value, expected: &Value| {
            worst = worst.max(relative(&numbers(found), &reordered(golden, joints, expected)));
        };
        hold(&found["gravity_n_m"], &expected["gravity_torque"]);
        hold(&found["inverse_dynamics_n_m"], &expected["rnea"]);
        hold(&found["forward_dynamics"], &expected["aba_zero_torque"]);
        for (row, name) in golden.joints().iter().enumerate() {
            let at = joints.as_array().unwrap().iter().position(|joint| joint == name).unwrap();
            hold(&found["mass_matrix"][at], &expected["mass_matrix"][row]);
        }
    }
    worst
}

#[test]
fn dynamics_agree_with_pinocchio() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    for name in ROBOTS {
        let robot = corpus.join("robots").join(name);
        let golden = Golden::load(&robot);
        let batch = text(&folder.path().join("batch.json"));
        golden.write_batch(&golden.configurations(&["zero", "random"]), batch.as_ref());
        let urdf = text(&robot.join("robot.urdf"));
        for (source, limit) in [("model", MODEL), ("simulation", SIMULATION)] {
            let worst = worst(&urdf, &batch, &golden, source);
            assert!(worst < limit, "{name} by {source}: {worst:e}");
        }
    }
}

/// With followers folded in: no torque at all gives the golden's accelerations, with the ratio kept, and the torques of a
/// motion give the motion.
#[test]
fn torques_of_driven_joints_are_those_of_their_accelerations() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    for name in ["panda", "xarm7_gripper"] {
        let robot = corpus.join("robots").join(name);
        let golden = Golden::load(&robot);
        let batch = text(&folder.path().join("batch.json"));
        let configurations = golden.configurations(&["zero", "random"]);
        golden.write_batch(&configurations, batch.as_ref());
        let urdf = text(&robot.join("robot.urdf"));
        for (source, limit) in [("model", MODEL), ("simulation", SIMULATION)] {
            let arguments = ["dynamics", &urdf, "--configurations", &batch, "--source", source];
            let report = congruent_json(&arguments).json();
            let joints = report["joints"].as_array().unwrap();
            assert!(joints.len() < golden.joints().len(), "{name} has followers");
            for (found, expected) in report["results"].as_array().unwrap().iter().zip(&configurations) {
                let expected = reordered(&golden, &report["joints"], &expected["aba_zero_torque_mimic"]);
                let off = relative(&numbers(&found["forward_dynamics"]), &expected);
                assert!(off < limit, "{name} by {source}: {off:e}");
                // M qdd + bias = 0 at the acceleration without torque.
                let accelerations = numbers(&found["forward_dynamics"]);
                let bias = numbers(&found["bias_n_m"]);
                let rows = found["mass_matrix"].as_array().unwrap();
                let torques: Vec<f64> = rows
                    .iter()
                    .map(|row| numbers(row).iter().zip(&accelerations).map(|(m, a)| m * a).sum::<f64>())
                    .zip(&bias)
                    .map(|(torque, bias)| torque + bias + 1.0)
                    .collect();
                let off = relative(&torques, &vec![1.0; torques.len()]);
                assert!(off < 1e2 * limit, "{name} by {source}: {off:e}");
            }
        }
    }
}

/// Gravity of a payload is its weight times the velocity of its place by each joint.
#[test]
fn a_payload_hangs_on_the_tcp() {
    let folder = tempfile::tempdir().unwrap();
    let batch = text(&folder.path().join("batch.json"));
    let q = json!([{ "q": { "shoulder_lift_joint": -0.7, "elbow_joint": 0.9, "wrist_1_joint": 0.4 } }]);
    std::fs::write(&batch, q.to_string()).unwrap();
    let ask = |command: &[&str]| {
        let all: Vec<&str> = command.iter().copied().chain(["--configurations", batch.as_str()]).collect();
        let answer = congruent_json(&all);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        answer.json()
    };
    let bare = numbers(&ask(&["dynamics", "robots/ur5e/ur5e.urdf"])["results"][0]["gravity_n_m"]);
    let laden = numbers(
        &ask(&["dynamics", "robots/ur5e/ur5e.urdf", "--payload", "2.5"])["results"][0]["gravity_n_m"],
    );
    let jacobian = ask(&["jacobian", "robots/ur5e/ur5e.urdf", "--link", "tool0"]);
    let up = numbers(&jacobian["results"][0]["linear"][2]);
    for ((laden, bare), up) in laden.iter().zip(&bare).zip(&up) {
        assert!((laden - bare - 2.5 * 9.81 * up).abs() < 1e-12, "{laden} {bare} {up}");
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for payload in ["0", "-1", "nan", "1,2", "1,2,3,inf", "heavy"] {
        let answer = congruent(&["dynamics", "robots/ur5e", "--payload", payload]);
        assert_eq!(answer.code, 2, "{payload}: {}", answer.stderr);
    }
    let Some(corpus) = corpus() else { return };
    let weightless = text(Path::new(&corpus.join("robots/fanuc_m10ia/robot.urdf")));
    for source in ["model", "simulation"] {
        let answer = congruent(&["dynamics", &weightless, "--source", source]);
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        assert!(answer.stderr.contains("link") || answer.stderr.contains("joint"), "{}", answer.stderr);
    }
}

/// Two light links with dry friction: it is right, or it is said that a joint is too slow for the physics to show it.
#[test]
fn dry_friction_of_a_slow_joint_is_right_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [urdf, batch] = ["slow.urdf", "batch.json"].map(|name| folder.path().join(name));
    let link = |name: &str| {
        format!(
            "<link name='{name}'><inertial><origin xyz='0.01 0.02 0.03'/><mass value='0.01'/>\
             <inertia ixx='5e-6' iyy='5e-6' izz='1e-6' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        )
    };
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='0 0 0.05'/><axis xyz='1 0 0'/><dynamics damping='3' friction='10'/></joint>"
        )
    };
    let text_of_urdf = format!(
        "<robot name='slow'><link name='base'/>{}{}{}{}</robot>",
        link("upper"),
        link("lower"),
        joint("one", "base", "upper"),
        joint("two", "upper", "lower")
    );
    std::fs::write(&urdf, text_of_urdf).unwrap();
    let [urdf, batch] = [&urdf, &batch].map(|path| text(path));
    let ask = |speed: f64, source: &str| {
        let state = json!([{ "q": { "one": 0.4, "two": 0.3 }, "v": { "one": 0.2, "two": speed } }]);
        std::fs::write(&batch, state.to_string()).unwrap();
        congruent_json(&["dynamics", &urdf, "--configurations", &batch, "--friction", "--source", source])
    };
    for speed in [0.5, -0.25] {
        let [model, simulation] = ["model", "simulation"]
            .map(|source| numbers(&ask(speed, source).json()["results"][0]["inverse_dynamics_n_m"]));
        let off = relative(&simulation, &model);
        assert!(off < 1e-6, "{speed}: {off:e}, {simulation:?} not {model:?}");
    }
    for speed in [0.1, 1e-3, 1e-9] {
        let refused = ask(speed, "simulation");
        assert_eq!(refused.code, 2, "{}", refused.stdout);
        let said = refused.json()["findings"][0]["message"].as_str().unwrap().to_owned();
        assert!(said.contains("\"two\"") && said.contains("dry friction stops it"), "{said}");
    }
}
