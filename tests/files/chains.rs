//! Which chain a command uses, and how configurations, targets and robots reach it.

use std::fs;

use serde_json::{Value, json};

use crate::support::{
    command::{Answer, congruent, congruent_json, congruent_with_input, text},
    corpus::workspace,
};

const RRR_ARM: &str = "robots/rrr_arm/rrr_arm.urdf";

#[track_caller]
fn refused(answer: &Answer, words: &[&str]) {
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    for word in words {
        assert!(answer.stderr.contains(word), "no {word:?} in {}", answer.stderr);
    }
}

/// All commands that use a chain, with what they need beside the robot.
fn commands(folder: &std::path::Path) -> Vec<Vec<String>> {
    let targets = folder.join("targets.json");
    fs::write(&targets, r#"[{"translation_m": [0.1, 0.1, 0.3]}]"#).unwrap();
    let measurements = folder.join("measurements.json");
    let row = r#"{"q": {"joint_1": 0.1, "joint_2": 0.2, "joint_3": 0.3, "joint_4": 0.1}, "translation_m": [0, 0, 0.4]}"#;
    fs::write(&measurements, format!("[{row}]")).unwrap();
    let samples = ["--samples", "20"].map(str::to_owned);
    let with = |command: &str, more: &[String]| [&[command.to_owned(), RRR_ARM.to_owned()], more].concat();
    vec![
        with("fk", &[]),
        with("jacobian", &[]),
        with("ik", &["--targets".to_owned(), text(&targets)]),
        with("manipulability", &[]),
        with("workspace", &samples),
        with("sensitivity", &samples),
        with("tolerances", &["--digits".to_owned()]),
        with("calibrate", &[text(&measurements)]),
        with("convert", &["--from", "urdf", "--to", "standard"].map(str::to_owned)),
        with("convert", &["--to", "poe"].map(str::to_owned)),
        with("check", &[]),
    ]
}

#[test]
fn every_command_says_which_chain_it_used() {
    let folder = tempfile::tempdir().unwrap();
    for command in commands(folder.path()) {
        let printed = congruent(&command).stdout;
        let line = "chain from base_link (chosen: the root link) to gripper_frame_cp (chosen: the end of the arm), 4 \
                    moving joints";
        assert!(printed.contains(line), "{command:?}: {printed}");
        let chain = congruent_json(&command).json()["chain"].clone();
        assert_eq!(
            (&chain["base_is"], &chain["tip_is"]),
            (&json!("chosen"), &json!("chosen")),
            "{command:?}"
        );
        let given = [&command[..], &["--base", "base_link", "--tip", "link_4"].map(str::to_owned)].concat();
        let chain = congruent_json(&given).json()["chain"].clone();
        let joints = json!(["joint_1", "joint_2", "joint_3", "joint_4"]);
        let expected = json!({"base": "base_link", "base_is": "given", "tip": "link_4", "tip_is": "given", "joints": joints});
        assert_eq!(chain, expected, "{command:?}");
    }
}

#[test]
fn declared_ends_are_declared_and_another_chain_loses_the_table() {
    let declared = congruent_json(&["check", "robots/rrr_arm"]).json();
    assert_eq!(
        (&declared["chain"]["tip_is"], &declared["table_compared"]),
        (&json!("declared"), &json!(true))
    );
    assert_eq!(declared["file"], "robots/rrr_arm/robot.toml");
    let other = congruent(&["check", "robots/rrr_arm", "--tip", "link_3"]);
    assert_eq!(other.code, 0, "{}", other.stderr);
    // Below the answer, as a finding of lint, and not as a warning as well.
    assert_eq!((other.stderr.as_str(), other.stdout.matches("the [dh] table describes").count()), ("", 2));
    assert!(other.stdout.lines().next().unwrap().ends_with("so it is not used"), "{}", other.stdout);
    // What is not compared is in the answer, also if warnings are not printed.
    let both = congruent(&["check", "robots/ur5e", "--tip", "wrist_1_link", "--quiet"]);
    let dropped = "; the [dh] table and the [[inertial]] entries describe the chain from \"base_link\" to \"tool0\", \
                   not from \"base_link\" to \"wrist_1_link\", so they are not used";
    assert!(both.stdout.lines().next().unwrap().ends_with(dropped), "{}", both.stdout);
    assert_eq!(both.stderr, "");
    let bare = congruent(&["check", RRR_ARM]).stdout;
    let answer = "NO SECOND DESCRIPTION. URDF and physics agree over the whole joint range";
    assert!(bare.starts_with(&format!("{RRR_ARM}: {answer}")), "{bare}");
}

/// Inverse kinematics of the bare URDF places the frame between the fingers, not a finger.
#[test]
fn inverse_kinematics_of_a_bare_urdf_places_the_tool() {
    let joints = [("joint_1", 0.4), ("joint_2", 0.3), ("joint_3", 0.5), ("joint_4", 0.2)];
    let at: Vec<String> = joints.iter().map(|(joint, value)| format!("--at={joint}={value}rad")).collect();
    let mut fk: Vec<&str> = vec!["fk", RRR_ARM];
    fk.extend(at.iter().map(String::as_str));
    let pose = congruent_json(&fk).json()["results"][0]["links"]["gripper_frame_cp"].clone();
    let start: Value =
        joints.iter().map(|(joint, value)| ((*joint).to_owned(), json!(value + 0.01))).collect();
    let target = json!([{"translation_m": pose["translation_m"], "quaternion_wxyz": pose["quaternion_wxyz"], "start": start}]);
    let found =
        congruent_with_input(&["ik", RRR_ARM, "--targets", "-", "--format", "json"], &target.to_string());
    assert_eq!(found.code, 0, "{}", found.stderr);
    for (joint, value) in joints {
        let q = found.json()["results"][0]["q"][joint].as_f64().unwrap();
        assert!((q - value).abs() < 1e-6, "{joint}: {q}");
    }
}

#[test]
fn positions_may_have_units_and_are_held_against_the_limits() {
    let translation = |at: &[&str]| {
        let answer = congruent_json(&[&["fk", "robots/cylindrical_rpp"], at].concat());
        assert_eq!(answer.code, 0, "{}", answer.stderr);
        answer.json()["results"][0]["links"]["flange"]["translation_m"].clone()
    };
    let by_si = translation(&["--at", "joint_1=1.5707963267948966rad", "--at", "joint_2=0.1"]);
    for (angle, shift) in [("90deg", "100mm"), ("90 deg", "0.1m"), ("1.5707963267948966rad", "1e2 mm")] {
        let found = translation(&["--at", &format!("joint_1={angle}"), "--at", &format!("joint_2={shift}")]);
        assert_eq!(found, by_si, "{angle} {shift}");
    }
    refused(
        &congruent(&["fk", "robots/cylindrical_rpp", "--at", "joint_2=90deg"]),
        &["\"90deg\" is an angle, expected a length"],
    );
    refused(
        &congruent(&["fk", "robots/cylindrical_rpp", "--at", "joint_1=deg"]),
        &["\"deg\" is not a number"],
    );
    refused(
        &congruent(&["fk", "robots/cylindrical_rpp", "--at", "joint_1=infrad"]),
        &["\"infrad\" is not a number"],
    );
    let outside = ["fk", "robots/ur5e", "--at", "elbow_joint=200deg"];
    let answer = congruent(&outside);
    assert_eq!(answer.code, 0);
    for word in ["configurations::outside_limits", "elbow_joint at 200 deg", "limits -180 deg to 180 deg"] {
        assert!(answer.stderr.contains(word), "no {word:?} in {}", answer.stderr);
    }
    assert_eq!(congruent_json(&outside).json()["warnings"][0]["code"], "configurations::outside_limits");
}

#[test]
fn files_of_configurations_are_refused_with_what_they_lack() {
    let fk = |input: &str| congruent_with_input(&["fk", "robots/ur5e", "--configurations", "-"], input);
    refused(&fk("[]"), &["the list has no configurations", r#"[{"q": {}}]"#]);
    refused(
        &fk("[{\"q\": {}},\n{\"q\": {\"elbow_joint\": 1,\n\"elbow_joint\": 2}}]"),
        &["configuration 2: \"elbow_joint\" is given twice", "-:3:"],
    );
    refused(
        &fk("{\"q\": {}}\n{\"q\": {\"elbow_joint\": 1, \"elbow_joint\": 2}}\n"),
        &["configuration 2: \"elbow_joint\" is given twice", "-:2:"],
    );
    refused(&fk(&format!("[{}]", vec!["{}"; 100_001].join(","))), &["100000", "per line (JSON Lines)"]);
    let two = fk(r#"[{"q": {"elbow_joint": 4}}, {"q": {"elbow_joint": 1}}, {"q": {"wrist_1_joint": -7}}]"#);
    assert_eq!(two.code, 0, "{}", two.stderr);
    assert_eq!(two.stderr.matches("configurations::outside_limits").count(), 1);
    for word in ["configuration 1: elbow_joint", "configuration 3: wrist_1_joint"] {
        assert!(two.stderr.contains(word), "no {word:?} in {}", two.stderr);
    }
    let row = r#"[{"q": {"joint_1": 0, "joint_1": 1, "joint_2": 0}, "translation_m": [0, 0, 0]}]"#;
    refused(
        &congruent_with_input(&["calibrate", "robots/planar_2r", "-"], row),
        &["\"joint_1\" is given twice"],
    );
}

#[test]
fn a_robot_may_come_from_standard_input_but_only_one_argument() {
    let urdf = fs::read_to_string(workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let by_file = congruent(&["fk", "robots/planar_2r/planar_2r.urdf"]);
    for name in ["-", "/dev/stdin"] {
        let by_input = congruent_with_input(&["fk", name], &urdf);
        assert_eq!((by_input.code, &by_input.stdout), (0, &by_file.stdout), "{}", by_input.stderr);
    }
    let both = congruent_with_input(&["fk", "-", "--configurations", "-"], &urdf);
    refused(&both, &["has already read standard input"]);
    let output = congruent_with_input(
        &["convert", "-", "--from", "urdf", "--to", "standard", "--to", "no.toml"],
        &urdf,
    );
    refused(&output, &["standard input"]);
}

#[test]
fn a_missing_file_is_answered_with_the_nearest_name() {
    refused(&congruent(&["fk", "robots/ur5e/robto.toml"]), &["did you mean robots/ur5e/robot.toml?"]);
    refused(&congruent(&["fk", "robots/ur5"]), &["did you mean robots/ur5e?"]);
    refused(&congruent(&["run", "scenarios/nowhere_near_anything_at_all.toml"]), &["does not exist"]);
}
