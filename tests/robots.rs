//! The robots that come with the project: table, URDF, screws and physics agree to rounding.

use std::fs;

use crate::{
    command::{congruent_json, text},
    corpus::workspace,
};

#[test]
fn every_robot_agrees_with_its_own_table() {
    let mut robots = 0;
    for entry in fs::read_dir(workspace().join("robots")).unwrap().flatten() {
        let answer = congruent_json(&["check", &text(&entry.path())]);
        let place = entry.path();
        assert_eq!(answer.code, 0, "{}: {}{}", place.display(), answer.stdout, answer.stderr);
        let report = answer.json();
        assert_eq!(report["verdict"], "agree");
        assert!(
            report["warnings"].as_array().unwrap().is_empty(),
            "{}: {}",
            place.display(),
            report["warnings"]
        );
        let names: Vec<&str> = report["comparisons"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|each| each["name"].as_str())
            .collect();
        assert_eq!(names, ["model_urdf", "poe_urdf", "urdf_simulation"]);
        robots += 1;
    }
    assert_eq!(robots, 7);
}

/// Reference case 21: the course's figure has 8 digits.
#[test]
fn case_21_rrr_arm_gripper_at_the_courses_configuration() {
    const DIGITS_M: f64 = 5e-9;
    for source in ["dh", "urdf", "poe", "simulation"] {
        let at = ["joint_1=1.0", "joint_2=1.0", "joint_3=1.5", "joint_4=1.5"];
        let mut arguments = vec!["fk", "robots/rrr_arm", "--source", source];
        arguments.extend(at.iter().flat_map(|value| ["--at", value]));
        let answer = congruent_json(&arguments);
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        let pose = &answer.json()["results"][0]["links"]["gripper_frame_cp"]["translation_m"];
        for (axis, expected) in [0.606_518_77, -0.217_123_93, 0.484_788_84].into_iter().enumerate() {
            let found = pose[axis].as_f64().unwrap();
            assert!((found - expected).abs() < DIGITS_M, "{source} axis {axis}: {found} not {expected}");
        }
    }
}
