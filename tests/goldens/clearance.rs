//! `congruent clearance` against distances in extended precision: four arms, every pair.

use crate::support::{
    command::{congruent_json, text},
    corpus::corpus,
    golden::{Golden, numbers, read_json},
};

/// Kind: solver stop of the distance query. Worst seen: 2.5e-8 m (iiwa14).
const DISTANCE_M: f64 = 1e-7;

#[track_caller]
fn check_robot(name: &str, pairs: usize) {
    let Some(corpus) = corpus() else { return };
    let robot = corpus.join("robots").join(name);
    let folder = tempfile::tempdir().unwrap();
    let batch = folder.path().join("batch.json");
    let golden = Golden::load(&robot);
    golden.write_batch(&golden.configurations(&["random"]), &batch);
    let urdf = text(&robot.join("robot.urdf"));
    let answer = congruent_json(&["clearance", &urdf, "--configurations", &text(&batch)]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let report = answer.json();
    let expected = read_json(&robot.join("clearance.json"));
    let found = report["pairs"].as_array().unwrap();
    assert_eq!(found.len(), pairs);
    for (index, pair) in expected["pairs"].as_array().unwrap().iter().enumerate() {
        let same = |other: &serde_json::Value| {
            (other[0] == pair[0] && other[1] == pair[1]) || (other[0] == pair[1] && other[1] == pair[0])
        };
        let ours = found.iter().position(same).unwrap_or_else(|| panic!("no pair {pair}"));
        for (configuration, exact) in expected["distances_m"].as_array().unwrap().iter().enumerate() {
            let exact = numbers(exact)[index];
            let distance = report["results"][configuration]["distances_m"][ours].as_f64().unwrap();
            assert!((distance - exact).abs() <= DISTANCE_M, "{pair} {configuration}: {distance} not {exact}");
            assert_eq!(distance == 0.0, exact == 0.0, "{pair} {configuration}: touching is not seen");
        }
    }
}

#[test]
fn ur5e() {
    check_robot("ur5e", 15);
}

#[test]
fn panda() {
    check_robot("panda", 42);
}

#[test]
fn iiwa14() {
    check_robot("iiwa14", 21);
}

#[test]
fn fanuc_m10ia() {
    check_robot("fanuc_m10ia", 15);
}
