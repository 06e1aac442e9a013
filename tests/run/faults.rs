//! Faults of the twin: every kind is seen by a check and diagnosed, none without a fault, and the table of the
//! documentation is the one that the command writes.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

/// The scenarios of `scenarios/faults/`, by name.
fn scenarios() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = root.join("scenarios/faults");
    let entries = fs::read_dir(folder).unwrap().flatten();
    let mut names: Vec<String> =
        entries.map(|entry| format!("scenarios/faults/{}", entry.file_name().display())).collect();
    names.sort();
    names
}

#[test]
fn every_scenario_goes_as_it_expects() {
    let (out, names) = (tempfile::tempdir().unwrap(), scenarios());
    let mut call = vec!["run", "--no-recording", "--out"];
    let folder = text(out.path());
    call.push(&folder);
    call.extend(names.iter().map(String::as_str));
    let answer = congruent_json(&call);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    for report in answer.json().as_array().unwrap() {
        let name = report["scenario"].as_str().unwrap();
        assert_eq!(report["verdict"], "as_expected", "{name}");
        let has_fault = report["faults"].as_array().is_some_and(|faults| !faults.is_empty());
        assert_eq!(has_fault, !name.contains("none"), "{name}");
        assert_eq!(report["diagnosis"].is_object(), has_fault, "{name}");
        // What was injected is no secret of the report alone: the resolved scenario runs again in the same way.
        if name == "fault_dropped_samples" {
            let resolved = text(&out.path().join(name).join("scenario.resolved.toml"));
            let again = text(&out.path().join("again"));
            let again = congruent_json(&["run", "--no-recording", "--out", &again, &resolved]).json();
            assert_eq!(again["trajectory_sha256"], report["trajectory_sha256"]);
            assert_eq!(again["diagnosis"], report["diagnosis"]);
        }
    }
}

#[test]
fn every_kind_has_a_scenario_and_every_check_sees_a_fault() {
    let names = scenarios();
    let mut call = vec!["run", "--faults"];
    call.extend(names.iter().map(String::as_str));
    let answer = congruent_json(&call);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let table: Value = answer.json();
    for empty in ["unseen", "false_alarms", "not_diagnosed", "broken", "blind_checks"] {
        assert_eq!(table[empty].as_array().unwrap().len(), 0, "{empty}: {}", table[empty]);
    }
    let rows = table["rows"].as_array().unwrap();
    let kinds: Vec<&str> = rows.iter().filter_map(|row| row["faults"][0]["kind"].as_str()).collect();
    let schema = congruent_json(&["schema", "faults"]).json();
    let all = schema["$defs"]["FaultKind"]["oneOf"].as_array().unwrap();
    assert_eq!(all.len(), 12);
    for kind in all {
        assert!(kinds.contains(&kind["const"].as_str().unwrap()), "no scenario for {kind}");
    }
}

#[test]
fn the_table_of_the_documentation_is_the_one_of_the_command() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let out = tempfile::tempdir().unwrap();
    let copy = out.path().join("faults.md");
    let document = fs::read_to_string(root.join("docs/faults.md")).unwrap();
    let (before, rest) = document.split_once("<!-- faults: begin -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- faults: end -->").unwrap();
    fs::write(&copy, format!("{before}<!-- faults: begin -->\n<!-- faults: end -->{after}")).unwrap();
    let (names, copied) = (scenarios(), text(&copy));
    let mut call = vec!["run", "--faults", "--markdown", &copied];
    call.extend(names.iter().map(String::as_str));
    assert_eq!(congruent(&call).code, 0);
    let help = "regenerate it: congruent faults scenarios/faults/*.toml --markdown docs/faults.md";
    assert_eq!(fs::read_to_string(&copy).unwrap(), document, "{help}");
}

/// A scenario with these faults and checks.
fn written(folder: &Path, controller: &str, rest: &str) -> String {
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../robots/ur5e");
    let path = folder.join("scenario.toml");
    let scenario = format!(
        "schema_version = 1\nname = \"made\"\nrobot = \"{}\"\n[simulation]\nduration_s = 0.2\n[start]\n\
         joints_deg = {{ shoulder_lift_joint = -90, elbow_joint = 90 }}\n[controller]\nkind = \"{controller}\"\n{rest}",
        text(&robot)
    );
    fs::write(&path, scenario).unwrap();
    text(&path)
}

#[test]
fn a_fault_that_no_check_sees_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let unseen = "[[fault]]\nkind = \"encoder_offset\"\njoint = \"elbow_joint\"\nvalue_mm = 1\n[[check]]\nkind = \"limits\"\n";
    let path = written(folder.path(), "kinematic", &unseen.replace("value_mm", "value_deg"));
    let answer = congruent(&["run", "--faults", &path]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    for expected in ["not detected by any check: made", "checks that detect none of these faults: limits"] {
        assert!(answer.stdout.contains(expected), "{}", answer.stdout);
    }
}

/// The finding on a wrong `[[fault]]`, at the place of a word of it.
#[track_caller]
fn refused(controller: &str, fault: &str, code: &str, place: &str, help: &str) {
    let folder = tempfile::tempdir().unwrap();
    let rest = format!("[[fault]]\n{fault}\n[[check]]\nkind = \"limits\"\n");
    let path = written(folder.path(), controller, &rest);
    let answer = congruent_json(&["run", &path, "--no-recording", "--out", &text(folder.path())]);
    assert_eq!(answer.code, 2, "{}{}", answer.stdout, answer.stderr);
    let finding = &answer.json()["findings"][0];
    assert_eq!(finding["code"], code, "{finding}");
    assert!(finding["help"].as_str().unwrap_or_default().contains(help), "{finding}");
    let written = fs::read_to_string(&path).unwrap();
    let line = 1 + written[..written.find(place).unwrap()].matches('\n').count();
    assert_eq!(finding["line"], line, "{finding}");
}

#[test]
fn a_wrong_fault_is_refused_at_its_place() {
    let offset = "kind = \"encoder_offset\"\njoint = \"elbow_joint\"\n";
    refused(
        "kinematic",
        "kind = \"encoder_ofset\"",
        "scenario::unknown_kind",
        "encoder_ofset",
        "encoder_offset",
    );
    let unknown = offset.replace("elbow", "elbw") + "value_deg = 1";
    refused("kinematic", &unknown, "scenario::unknown_joint", "elbw", "elbow_joint");
    refused("kinematic", offset, "scenario::fault_value", "[[fault]]", "`value_rad` or `value_deg`");
    let metres = format!("{offset}value_mm = 1");
    refused("kinematic", &metres, "scenario::joint_unit", "value_mm", "`value_rad` or `value_deg`");
    let zero = format!("{offset}value_deg = 0.0");
    refused("kinematic", &zero, "scenario::fault_value", "value_deg", "");
    let late = format!("{offset}value_deg = 1\nat_s = 7.0");
    refused("kinematic", &late, "scenario::fault_time", "at_s", "0.2 s");
    let rounded = format!("{offset}value_deg = 1\nat_s = 0.1999");
    refused("kinematic", &rounded, "scenario::fault_time", "at_s", "0.2 s");
    let ended = format!("{offset}value_deg = 1\nat_s = 0.1\nuntil_s = 0.1");
    refused("kinematic", &ended, "scenario::fault_time", "until_s", "");
    let lost = "kind = \"lost_torque\"\njoint = \"elbow_joint\"";
    refused("kinematic", lost, "scenario::fault_no_effect", "lost_torque", "pd");
    refused("passive", lost, "scenario::fault_no_effect", "lost_torque", "pd");
    let share = "kind = \"dropped_samples\"\nshare = 1.5";
    refused("kinematic", share, "scenario::fault_value", "share", "");
    let same = "kind = \"swapped_joints\"\njoints = [\"elbow_joint\", \"elbow_joint\"]";
    refused("kinematic", same, "scenario::fault_value", "joints = [\"elbow", "another joint");
    for (time_s, help) in
        [("0.0015", "give 0.001 s or 0.002 s"), ("0.0004", "give 0.001 s"), ("-0.001", ""), ("nan", "")]
    {
        let latency = format!("kind = \"latency\"\ntime_s = {time_s}");
        refused("kinematic", &latency, "scenario::fault_value", "time_s", help);
    }
    for mass_kg in ["1e9", "-1.0", "nan", "inf", "0.0"] {
        let load = format!("kind = \"wrong_payload\"\nmass_kg = {mass_kg}");
        refused("gravity_compensation", &load, "scenario::fault_value", "mass_kg", "");
    }
    let key = format!("{offset}value_deg = 1\nshare = 0.5");
    refused("kinematic", &key, "toml::unknown_key", "share", "encoder_offset");
    let twice = "kind = \"flipped_axis\"\njoint = \"elbow_joint\"\n[[fault]]\nkind = \"swapped_joints\"\n\
                 joints = [\"wrist_1_joint\", \"elbow_joint\"]";
    refused("kinematic", twice, "scenario::faults_exclude", "[[fault]]\nkind = \"swapped", "until_s");
}

/// Encoder and drive count the other way round: at 2.4 deg the arm is never farther than 5 deg from its setpoint.
#[test]
fn a_small_motion_the_other_way_fails_by_default() {
    let folder = tempfile::tempdir().unwrap();
    let robot = text(&workspace().join("robots/ur5e"));
    let contents = format!(
        "schema_version = 1\nname = \"opposite\"\nrobot = {robot:?}\n[simulation]\nstep_s = 0.001\nduration_s = 2.0\n\
         [start]\njoints_deg = {{ shoulder_lift_joint = -90.0, elbow_joint = 90.0 }}\n\
         [controller]\nkind = \"pd\"\nstiffness = 300\ndamping = 60\n\
         [[motion]]\nmove_joints_deg = {{ shoulder_pan_joint = 2.4 }}\nduration_s = 0.8\n\
         [[fault]]\nkind = \"flipped_axis\"\njoint = \"shoulder_pan_joint\"\n[[check]]\nkind = \"limits\"\n"
    );
    let scenario = folder.path().join("opposite.toml");
    fs::write(&scenario, contents).unwrap();
    let out = text(&folder.path().join("out"));
    let answer = congruent(&["run", &text(&scenario), "--out", &out, "--no-recording", "--allow", &robot]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("share of travel -1.0"), "{}", answer.stdout);
}
