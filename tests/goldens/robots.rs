//! The robots that come with the project: table, URDF, screws and physics agree to rounding.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
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
        let at = ["joint_1=1rad", "joint_2=1rad", "joint_3=1.5rad", "joint_4=1.5rad"];
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
            .map(|(joint, degrees)| format!("{joint}={}rad", degrees.to_radians()));
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

/// Kind: rounding of up to eight joints within 1 m, by four sources; worst seen 1.4e-15.
const ROUNDING: f64 = 4e-15;

#[track_caller]
fn assert_near(found: &Value, expected: &[f64]) {
    let found = numbers(found);
    assert_eq!(found.len(), expected.len());
    for (entry, expected) in found.iter().zip(expected) {
        assert!((entry - expected).abs() <= ROUNDING, "{found:?}: {entry} not {expected}");
    }
}

/// The arm of case 3 by hand: its joints are 0.3, 0.7 and 1 m away from the TCP when it is stretched along x, the
/// first turns about z, the others about -y.
#[test]
fn case_06_zero_pose_and_one_axis_at_a_time() {
    let answer = congruent_json(&["check", "robots/spatial_3r"]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let basics = &answer.json()["basics"];
    let (ten, half) = (10_f64.to_radians(), 0.5_f64.sqrt());
    let (sin, cos) = ten.sin_cos();
    for source in ["model", "urdf"] {
        let zero = &basics["zero"][source];
        assert_near(&zero["translation_m"], &[1.0, 0.0, 0.2]);
        assert_near(&zero["quaternion_wxyz"], &[half, half, 0.0, 0.0]);
        let lifted = |arm_m: f64| [arm_m * (cos - 1.0), 0.0, arm_m * sin];
        let expected = [
            ("joint_1", [cos - 1.0, sin, 0.0], [0.0, 0.0, ten]),
            ("joint_2", lifted(0.7), [0.0, -ten, 0.0]),
            ("joint_3", lifted(0.3), [0.0, -ten, 0.0]),
        ];
        for (joint, (name, shift_m, turn_rad)) in basics["joints"].as_array().unwrap().iter().zip(expected) {
            assert_eq!((&joint["joint"], &joint["unit"]), (&Value::from(name), &Value::from("rad")));
            let motion = &joint["motion"][source];
            assert_near(&motion["shift_m"], &shift_m);
            assert_near(&motion["turn_rad"], &turn_rad);
            let length_m = shift_m.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
            let direction = shift_m.map(|entry| entry / length_m);
            for (found, expected) in numbers(&motion["direction"]).into_iter().zip(direction) {
                assert!((found - expected).abs() <= ROUNDING / length_m, "{name}: {found} not {expected}");
            }
        }
    }
    // A person sees the same.
    let shown = congruent(&["check", "robots/spatial_3r", "--basics"]).stdout;
    assert!(shown.contains("joint_2  +10 deg both   shift   -10.635     0.000   121.554 mm"), "{shown}");
    assert!(!congruent(&["check", "robots/spatial_3r"]).stdout.contains("shift"));
}

#[test]
fn case_06_transforms_are_rigid_motions_and_their_inverses_undo_them() {
    for entry in fs::read_dir(workspace().join("robots")).unwrap().flatten() {
        let basics = congruent_json(&["check", &text(&entry.path())]).json()["basics"].clone();
        for key in ["orthonormality_error", "determinant_error", "round_trip_m", "round_trip_rad"] {
            let error = basics[key].as_f64().unwrap();
            assert!(error <= ROUNDING, "{}: {key} {error:e}", entry.path().display());
        }
    }
}

/// The closed form of the arm, by hand, is the independent source: eighteen configurations, eight of them a
/// thousandth of a degree within both ends of every range.
#[test]
fn case_06_near_the_limits_and_against_the_closed_form() {
    let ends = [[-169.999, 169.999], [-89.999, 119.999], [-149.999, 149.999]];
    let mut all_degrees: Vec<[f64; 3]> =
        (0..8).map(|at| [0, 1, 2].map(|joint| ends[joint][at >> joint & 1])).collect();
    all_degrees
        .extend((0..10).map(|at| [37.0, 17.0, 23.0].map(|step| (step * f64::from(at) * 1.7) % 80.0 - 30.0)));
    let all_radians: Vec<[f64; 3]> =
        all_degrees.into_iter().map(|degrees| degrees.map(f64::to_radians)).collect();
    let batch: Vec<Value> = all_radians
        .iter()
        .map(|[one, two, three]| json!({"q": {"joint_1": one, "joint_2": two, "joint_3": three}}))
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let file = text(&folder.path().join("batch.json"));
    fs::write(&file, json!(batch).to_string()).unwrap();
    for source in ["dh", "urdf", "poe", "simulation"] {
        let answer =
            congruent_json(&["fk", "robots/spatial_3r", "--source", source, "--configurations", &file]);
        let results = answer.json()["results"].clone();
        assert_eq!(results.as_array().unwrap().len(), 18);
        for (result, [one, two, three]) in results.as_array().unwrap().iter().zip(&all_radians) {
            let reach_m = 0.3 + 0.4 * two.cos() + 0.3 * (two + three).cos();
            let height_m = 0.2 + 0.4 * two.sin() + 0.3 * (two + three).sin();
            let expected = [reach_m * one.cos(), reach_m * one.sin(), height_m];
            assert_near(&result["links"]["tcp"]["translation_m"], &expected);
        }
    }
}
