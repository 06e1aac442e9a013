//! `congruent jacobian` against Pinocchio: the tips of every robot of the corpus, in every
//! configuration.

use std::{
    fs,
    path::{Path, PathBuf},
};

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::corpus,
    golden::{Golden, numbers},
};

/// Kind: rounding, of arms that reach 2 m. m or rad for each rad or m.
const ENTRY: f64 = 1e-12;
/// Kind: truncation and rounding of differences along the motion, Richardson's fourth order with
/// h = 2^-12 s: 4 h^4/30 times the fifth derivative, up to 10^4 with eight joints at up to 1 rad/s,
/// is 5e-12; rounding over h is 1e-11. Worst seen 3.4e-12.
const DIFFERENCE: f64 = 2e-11;
const STEP_S: f64 = 1.0 / 4096.0;

/// Columns of the golden by joint name, since two programs order joints differently.
#[track_caller]
fn hold(found: &Value, joints: &Value, golden: &Golden, rows: &Value) {
    for (row, expected) in rows.as_array().unwrap().iter().enumerate() {
        let block = if row < 3 { "linear" } else { "angular" };
        for (name, expected) in golden.joints().iter().zip(numbers(expected)) {
            let column = joints.as_array().unwrap().iter().position(|joint| joint == name).unwrap();
            let entry = found[block][row % 3][column].as_f64().unwrap();
            assert!((entry - expected).abs() <= ENTRY, "{name} {block} {row}: {entry} not {expected}");
        }
    }
}

fn robots(corpus: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(corpus.join("robots")).unwrap().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_dir()).collect()
}

#[test]
fn geometric_jacobians_agree_with_pinocchio() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut tips = 0;
    for robot in robots(&corpus) {
        let golden = Golden::load(&robot);
        let configurations = golden.configurations(&["zero", "axis", "random"]);
        let batch = text(&folder.path().join("batch.json"));
        golden.write_batch(&configurations, batch.as_ref());
        let urdf = text(&robot.join("robot.urdf"));
        for tip in configurations[0]["jacobian"].as_object().unwrap().keys() {
            let arguments =
                ["jacobian", &urdf, "--link", tip, "--free-followers", "--configurations", &batch];
            let answer = congruent_json(&arguments);
            assert_eq!(answer.code, 0, "{urdf}: {}", answer.stderr);
            let report = answer.json();
            for (index, configuration) in configurations.iter().enumerate() {
                let found = &report["results"][index];
                hold(found, &report["joints"], &golden, &configuration["jacobian"][tip]);
            }
            tips += 1;
        }
    }
    assert!(tips >= 9, "{tips} tips");
}

/// The blocks of the command for a batch: `results[i]` with or without `derivative`.
fn results(golden: &Golden, configurations: &[&Value], arguments: &[&str]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let batch = folder.path().join("batch.json");
    golden.write_batch(configurations, &batch);
    let batch = text(&batch);
    let answer = congruent_json(&[&["jacobian"], arguments, &["--configurations", &batch]].concat());
    assert_eq!(answer.code, 0, "{arguments:?}: {}", answer.stderr);
    answer.json()["results"].as_array().unwrap().clone()
}

/// The same configuration some seconds later, at constant speed.
fn later(configuration: &Value, seconds: f64) -> Value {
    let moved = numbers(&configuration["q"]).into_iter().zip(numbers(&configuration["v"]));
    json!({ "q": moved.map(|(q, v)| q + v * seconds).collect::<Vec<f64>>() })
}

/// Holds derivatives against differences of the Jacobians that the goldens were held against.
#[track_caller]
fn hold_derivatives(golden: &Golden, arguments: &[&str]) {
    let all = golden.configurations(&["random"]);
    let moving = &all[..10];
    let derivatives = results(golden, moving, &[arguments, &["--derivative"]].concat());
    let at = |steps: f64| {
        let moved: Vec<Value> = moving.iter().map(|each| later(each, steps * STEP_S)).collect();
        results(golden, &moved.iter().collect::<Vec<_>>(), arguments)
    };
    let [ahead, behind, far_ahead, far_behind] = [1.0, -1.0, 2.0, -2.0].map(at);
    for (index, result) in derivatives.iter().enumerate() {
        for (block, row) in
            ["linear", "angular"].into_iter().flat_map(|block| [0, 1, 2].map(|row| (block, row)))
        {
            let of = |results: &[Value]| numbers(&results[index][block][row]);
            let (ahead, behind, far_ahead, far_behind) =
                (of(&ahead), of(&behind), of(&far_ahead), of(&far_behind));
            for (column, found) in numbers(&result["derivative"][block][row]).into_iter().enumerate() {
                let fine = (ahead[column] - behind[column]) / (2.0 * STEP_S);
                let coarse = (far_ahead[column] - far_behind[column]) / (4.0 * STEP_S);
                let expected = (4.0 * fine - coarse) / 3.0;
                assert!(
                    (found - expected).abs() <= DIFFERENCE,
                    "{arguments:?} {index} {block} {row} {column}: {found} not {expected}"
                );
            }
        }
    }
}

#[test]
fn derivatives_are_what_the_jacobians_do_along_the_motion() {
    let Some(corpus) = corpus() else { return };
    let mut tips = 0;
    for robot in robots(&corpus) {
        let golden = Golden::load(&robot);
        let urdf = text(&robot.join("robot.urdf"));
        for tip in golden.configurations(&["random"])[0]["jacobian"].as_object().unwrap().keys() {
            for kind in ["space", "body", "geometric"] {
                hold_derivatives(&golden, &[&urdf, "--link", tip, "--kind", kind]);
            }
            tips += 1;
        }
    }
    assert!(tips >= 9, "{tips} tips");
}

/// The planar arm stretched along x, its shoulder turning by 2 rad/s: every velocity turns with it.
#[test]
fn the_derivative_of_a_stretched_arm_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let batch = text(&folder.path().join("batch.json"));
    fs::write(&batch, r#"[{"v": {"joint_1": 2.0}}, {"q": {"joint_1": 0.3}}]"#).unwrap();
    let arguments = ["jacobian", "robots/planar_2r", "--derivative", "--configurations", &batch];
    let document = congruent_json(&arguments).json();
    let derivative = |index: usize, block: &str, row: usize| {
        numbers(&document["results"][index]["derivative"][block][row])
    };
    for (found, expected) in derivative(0, "linear", 0).into_iter().zip([-2.0, -0.8]) {
        assert!((found - expected).abs() < ENTRY, "{found} not {expected}");
    }
    for (index, block, row) in [(0, "linear", 1), (0, "angular", 2), (1, "linear", 0), (1, "linear", 1)] {
        assert_eq!(derivative(index, block, row), [0.0, 0.0], "{index} {block} {row}");
    }
    assert!(congruent(&arguments).stdout.contains("derivative, per s"));
}

#[test]
fn a_derivative_without_speeds_or_with_speeds_that_cannot_be_is_refused() {
    let answer = congruent(&["jacobian", "robots/planar_2r", "--derivative", "--at", "joint_1=1rad"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("--configurations FILE"), "{}", answer.stderr);
    let folder = tempfile::tempdir().unwrap();
    let batch = text(&folder.path().join("batch.json"));
    let refused = |batch_text: &str, words: &[&str]| {
        fs::write(&batch, batch_text).unwrap();
        let answer = congruent(&["jacobian", "robots/panda", "--derivative", "--configurations", &batch]);
        assert_eq!(answer.code, 2, "{}", answer.stdout);
        for word in words {
            assert!(answer.stderr.contains(word), "no {word:?} in {}", answer.stderr);
        }
    };
    refused(r#"[{"v": {"panda_joint9": 1}}]"#, &["configuration 1", "panda_joint9"]);
    refused(
        r#"[{}, {"v": {"panda_finger_joint1": 1, "panda_finger_joint2": 2}}]"#,
        &["configuration 2", "mimics"],
    );
}

/// The three kinds of the planar arm, turned to stand along y, by hand: link lengths 0.6 and 0.4 m.
#[test]
fn kinds_differ_by_frame_and_point() {
    let check = |kind: &str, linear_x: [f64; 2], linear_y: [f64; 2]| {
        let quarter_turn = format!("joint_1={}rad", std::f64::consts::FRAC_PI_2);
        let answer = congruent_json(&["jacobian", "robots/planar_2r", "--kind", kind, "--at", &quarter_turn]);
        let blocks = &answer.json()["results"][0];
        assert_eq!(numbers(&blocks["angular"][2]), [1.0, 1.0]);
        for (row, expected) in [(0, linear_x), (1, linear_y)] {
            for (found, expected) in numbers(&blocks["linear"][row]).into_iter().zip(expected) {
                assert!((found - expected).abs() < ENTRY, "{kind} row {row}: {found} not {expected}");
            }
        }
    };
    check("space", [0.0, 0.6], [0.0, 0.0]);
    check("body", [0.0, 0.0], [1.0, 0.4]);
    check("geometric", [-1.0, -0.4], [0.0, 0.0]);
}

#[test]
fn an_unknown_link_is_refused_with_the_nearest() {
    let answer = congruent(&["jacobian", "robots/ur5e", "--link", "tool"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("did you mean \"tool0\"?"), "{}", answer.stderr);
}
