//! `congruent jacobian` against Pinocchio: the tips of every robot of the corpus, in every
//! configuration.

use std::fs;

use serde_json::Value;

use crate::{
    command::{congruent, congruent_json, text},
    corpus::corpus,
    golden::{Golden, numbers},
};

/// Kind: rounding, of arms that reach 2 m. m or rad for each rad or m.
const ENTRY: f64 = 1e-12;

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

#[test]
fn geometric_jacobians_agree_with_pinocchio() {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut tips = 0;
    for entry in fs::read_dir(corpus.join("robots")).unwrap().flatten().filter(|entry| entry.path().is_dir())
    {
        let golden = Golden::load(&entry.path());
        let configurations = golden.configurations(&["zero", "axis", "random"]);
        let batch = text(&folder.path().join("batch.json"));
        golden.write_batch(&configurations, batch.as_ref());
        let urdf = text(&entry.path().join("robot.urdf"));
        for tip in configurations[0]["jacobian"].as_object().unwrap().keys() {
            let arguments = ["jacobian", &urdf, "--link", tip, "--configurations", &batch];
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

/// The three kinds of the planar arm, turned to stand along y, by hand: link lengths 0.6 and 0.4 m.
#[test]
fn kinds_differ_by_frame_and_point() {
    let check = |kind: &str, linear_x: [f64; 2], linear_y: [f64; 2]| {
        let quarter_turn = format!("joint_1={}", std::f64::consts::FRAC_PI_2);
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
