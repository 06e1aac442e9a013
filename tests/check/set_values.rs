//! `--set` of a robot: answers about values that no file has.

use std::fs;

use serde_json::Value;

use crate::support::{
    command::{congruent, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

fn ur5e() -> String {
    text(&workspace().join("robots/ur5e"))
}

fn json(arguments: &[&str]) -> Value {
    let answer = congruent(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str(&answer.stdout).unwrap_or_else(|_| panic!("{answer:?}"))
}

#[test]
fn a_table_with_another_value_is_another_robot() {
    let robot = ur5e();
    let set = ["check", &robot, "--set", "dh.row.elbow_joint.a_m=-0.39"];
    let answer = congruent(&set);
    assert_eq!(answer.code, 1, "{answer:?}");
    // The answer says that it is of a value that the file does not have.
    for words in ["a_m = -0.39, expected a_m = -0.3922", "; --set dh.row.elbow_joint.a_m=-0.39"] {
        assert!(answer.stdout.contains(words), "{answer:?}");
    }
    assert_eq!(json(&set)["chain"]["set_values"], serde_json::json!(["dh.row.elbow_joint.a_m=-0.39"]));
    assert_eq!(congruent(&["check", &robot]).code, 0, "the file is as it was");
}

#[test]
fn the_value_of_a_link_or_joint_counts_whichever_file_has_it() {
    let robot = ur5e();
    let origin = |set: &[&str]| {
        let fk = json(&[&["fk", &robot, "--at", "elbow_joint=0"], set].concat());
        fk["results"][0]["links"]["forearm_link"]["translation_m"][0].as_f64().unwrap()
    };
    // As in a scenario the key may begin with robot.: the same value, -0.425 in the file.
    let shifted = origin(&["--set", "robot.joint.elbow_joint.xyz_m.1=-0.5"]);
    assert!(((shifted - origin(&[])).abs() - 0.075).abs() < 1e-12, "{shifted}");
    let torque = |set: &[&str]| {
        let dynamics = json(&[&["dynamics", &robot, "--at", "elbow_joint=0"], set].concat());
        dynamics["results"][0]["gravity_n_m"][1].as_f64().unwrap()
    };
    let heavier = torque(&["--set", "link.forearm_link.mass_kg=3.846"]);
    assert!((heavier - torque(&[])).abs() > 1.0, "one kilogram more, half a metre out: {heavier}");
}

#[test]
fn what_cannot_be_set_is_refused() {
    let robot = ur5e();
    let refused = |arguments: &[&str], words: &str| {
        let answer = congruent(arguments);
        let printed: Vec<&str> = answer.stderr.split_whitespace().filter(|word| *word != "│").collect();
        assert!(answer.code == 2 && printed.join(" ").contains(words), "{answer:?}");
    };
    refused(&["check", &robot, "--set", "link.forearm_link.mass_kg=3"], "this is a key of no file");
    refused(&["fk", &robot, "--set", "link.forearm.mass_kg=3"], "did you mean \"forearm_link\"");
    refused(&["fk", &robot, "--set", "dh.row.elbow.a_m=3"], "elbow_joint");
    refused(&["fk", &robot, "--set", "link.forearm_link.mass_kg=-3"], "-3 is negative");
    refused(&["check", &robot, "--set", "tcp.xyz_m.3=0.2", "--fix"], "cannot be used with");
    let twice = [
        "fk",
        &robot,
        "--set",
        "joint.elbow_joint.rpy_deg=[0,0,1]",
        "--set",
        "joint.elbow_joint.rpy_rad.3=0",
    ];
    refused(&twice, "the same value is set by joint.elbow_joint.rpy_deg=[0,0,1]");
    let alias = ["fk", &robot, "--set", "dh.row.3.a_m=1", "--set", "dh.row.elbow_joint.a_m=2"];
    refused(&alias, "the same value is set by dh.row.3.a_m=1");
    refused(&["fk", &robot, "--set", "joint.flange-tool0.friction=1"], "the joint is fixed");
    refused(&["fk", &robot, "--set", "link.forearm_link.mass_kg.1=3"], "is one number");
    let scratch = ScratchFolder::new();
    let urdf =
        scratch.write("arm.urdf", &fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap());
    refused(&["fk", &urdf, "--set", "tcp.xyz_m.3=0.2"], "is no robot file (robot.toml), which has such keys");
}
