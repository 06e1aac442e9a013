//! `congruent fk` against Pinocchio: every link of every robot of the corpus, in every configuration.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{congruent_json, text},
    corpus::corpus,
    golden::{Golden, angle_rad, distance_m, numbers},
};

/// Kind: rounding, of 57 links at most 2 m away. Worst seen: 2.7e-15 m.
const POSITION_M: f64 = 1e-12;
/// Kind: rounding. Worst seen: 1.3e-14 rad (`xarm7_gripper` by screws).
const ORIENTATION_RAD: f64 = 1e-12;

#[track_caller]
fn check_source(source: &str) {
    let Some(corpus) = corpus() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut robots = 0;
    for entry in fs::read_dir(corpus.join("robots")).unwrap().flatten().filter(|entry| entry.path().is_dir())
    {
        let robot = entry.path();
        let golden = Golden::load(&robot);
        let configurations = golden.configurations(&["zero", "axis", "random"]);
        assert!(configurations.len() > 50, "{}: too few configurations", robot.display());
        let batch = folder.path().join("batch.json");
        golden.write_batch(&configurations, &batch);
        let urdf = text(&robot.join("robot.urdf"));
        let answer = congruent_json(&["fk", &urdf, "--source", source, "--configurations", &text(&batch)]);
        assert_eq!(answer.code, 0, "{}: {}", robot.display(), answer.stderr);
        let report = answer.json();
        for (index, configuration) in configurations.iter().enumerate() {
            for (link, golden) in golden.links().iter().zip(configuration["poses"].as_array().unwrap()) {
                let place = format!("{} {link}, configuration {index}", robot.display());
                let pose = &report["results"][index]["links"][link];
                let golden = numbers(golden);
                let apart_m = distance_m(&numbers(&pose["translation_m"]), &golden[..3]);
                assert!(apart_m <= POSITION_M, "{place}: {apart_m:e} m");
                let turned_rad = angle_rad(&numbers(&pose["quaternion_wxyz"]), &golden[3..]);
                assert!(turned_rad <= ORIENTATION_RAD, "{place}: {turned_rad:e} rad");
            }
        }
        robots += 1;
    }
    assert_eq!(robots, 9);
}

/// Reference case 6 on real robots: each joint moved alone by 10 degrees or 10 mm, against differences of
/// Pinocchio's poses.
#[test]
fn case_06_the_direction_in_which_each_joint_moves_the_tip() {
    let Some(corpus) = corpus() else { return };
    let mut joints = 0;
    for entry in fs::read_dir(corpus.join("robots")).unwrap().flatten().filter(|entry| entry.path().is_dir())
    {
        let robot = entry.path();
        let golden = Golden::load(&robot);
        let answer = congruent_json(&["check", &text(&robot.join("robot.urdf"))]);
        assert_eq!(answer.code, 0, "{}: {}", robot.display(), answer.stderr);
        let basics = &answer.json()["basics"];
        let tip = golden.links().iter().position(|link| basics["tip"] == **link).unwrap();
        let tip_at = |configuration: &Value| numbers(&configuration["poses"][tip]);
        let zero = tip_at(golden.configurations(&["zero"])[0]);
        let moved = golden.configurations(&["axis"]);
        for motion in basics["joints"].as_array().unwrap() {
            let joint = golden.joints().iter().position(|joint| motion["joint"] == **joint).unwrap();
            let alone = moved.iter().find(|configuration| numbers(&configuration["q"])[joint] > 0.0);
            let golden = tip_at(alone.unwrap());
            let shift: Vec<f64> =
                golden.iter().zip(&zero).take(3).map(|(after, before)| after - before).collect();
            let motion = &motion["motion"]["urdf"];
            let apart_m = distance_m(&numbers(&motion["shift_m"]), &shift);
            assert!(apart_m <= POSITION_M, "{} joint {joint}: {apart_m:e} m", robot.display());
            let turn_rad = distance_m(&numbers(&motion["turn_rad"]), &[0.0; 3]);
            let off_rad = (turn_rad - angle_rad(&golden[3..], &zero[3..])).abs();
            assert!(off_rad <= ORIENTATION_RAD, "{} joint {joint}: {off_rad:e} rad", robot.display());
            joints += 1;
        }
    }
    assert_eq!(joints, 68);
}

#[test]
fn urdf_agrees_with_pinocchio() {
    check_source("urdf");
}

#[test]
fn screws_agree_with_pinocchio() {
    check_source("poe");
}

#[test]
fn simulation_agrees_with_pinocchio() {
    check_source("simulation");
}
