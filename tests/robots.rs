//! The robots that come with the project: table, URDF, screws and physics agree to rounding.

use std::fs;

use crate::{
    command::{congruent_json, text},
    corpus::workspace,
    golden::numbers,
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

/// Reference case 5, on the arm of case 3: the second configuration is one whose product of quaternions
/// has w < 0. Position and quaternion by mpmath 1.3 with 30 digits, printed with 12.
#[test]
fn case_05_joint_states_by_name_in_tcp_out() {
    /// Golden digits: half a unit of the twelfth decimal, and rounding.
    const PRINTED: f64 = 5.1e-13;
    let check = |[joint_1, joint_2, joint_3]: [f64; 3], position: [f64; 3], wxyz: [f64; 4]| {
        // By name: the order on the command line does not count.
        let at = [("joint_3", joint_3), ("joint_1", joint_1), ("joint_2", joint_2)]
            .map(|(joint, degrees)| format!("{joint}={}", degrees.to_radians()));
        for source in ["dh", "urdf", "poe", "simulation"] {
            let mut arguments = vec!["fk", "robots/spatial_3r", "--source", source];
            arguments.extend(at.iter().flat_map(|value| ["--at", value]));
            let answer = congruent_json(&arguments);
            assert_eq!(answer.code, 0, "{}", answer.stderr);
            let tcp = &answer.json()["results"][0]["links"]["tcp"];
            for (key, expected) in [("translation_m", &position[..]), ("quaternion_wxyz", &wxyz[..])] {
                for (found, expected) in numbers(&tcp[key]).into_iter().zip(expected) {
                    assert!((found - expected).abs() < PRINTED, "{source} {key}: {found} not {expected}");
                }
            }
        }
    };
    check(
        [20.0, -30.0, 40.0],
        [0.885_051_832_295, 0.322_132_522_738, 0.052_094_453_300],
        [0.683_012_701_892, 0.704_416_026_403, 0.061_628_416_716, 0.183_012_701_892],
    );
    check(
        [160.0, 100.0, -20.0],
        [-0.265_590_195_119, 0.096_666_925_536, 0.889_365_427_109],
        [0.353_553_390_593, -0.541_675_220_420, -0.454_519_477_672, -0.612_372_435_696],
    );
}
