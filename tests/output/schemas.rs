//! The published schemas are those of the program, and files and documents of the project follow them.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    scenario_files::is_plan,
};

/// The names that `congruent schema` lists.
fn names() -> Vec<String> {
    let names = congruent_json(&["schema"]).json();
    names.as_array().unwrap().iter().map(|name| name.as_str().unwrap().to_owned()).collect()
}

fn validator(name: &str) -> jsonschema::Validator {
    jsonschema::draft202012::new(&congruent_json(&["schema", name]).json()).unwrap()
}

#[track_caller]
fn follows(name: &str, what: &str, document: &Value) {
    let faults: Vec<String> = validator(name)
        .iter_errors(document)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert!(faults.is_empty(), "{what} against the schema {name}: {faults:#?}");
}

fn toml_files(folder: &str) -> Vec<std::path::PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![workspace().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    files
}

fn read_toml(path: &Path) -> Value {
    let table: toml::Table = fs::read_to_string(path).unwrap().parse().unwrap();
    serde_json::to_value(table).unwrap()
}

#[test]
fn published_schemas_are_those_of_the_program() {
    for name in names() {
        let file = workspace().join("schemas").join(format!("{name}.json"));
        let published = fs::read_to_string(&file).unwrap_or_default();
        assert!(
            published == congruent(&["schema", &name]).stdout,
            "schemas/{name}.json is not the schema of the program; write it: congruent schema {name} > schemas/{name}.json"
        );
    }
    let published = fs::read_dir(workspace().join("schemas")).unwrap().count();
    assert_eq!(published, names().len(), "schemas/ holds a file that no document has");
}

#[test]
fn files_of_the_project_follow_their_schemas() {
    for (name, folder) in [("robot", "robots"), ("scenario", "scenarios")] {
        let files = toml_files(folder);
        assert!(files.len() > 5, "{folder}: {files:?}");
        for file in files {
            let name = if is_plan(&file) { "sweep_plan" } else { name };
            follows(name, &text(&file), &read_toml(&file));
        }
    }
}

#[test]
fn files_that_are_wrong_do_not_follow_their_schemas() {
    let base = read_toml(&workspace().join("robots/ur5e/robot.toml"));
    let scenario = read_toml(&workspace().join("scenarios/ur5e_pick.toml"));
    for (name, document, pointer, wrong) in [
        ("robot", &base, "/dh/convention", Value::from("craig")),
        ("robot", &base, "/dh/row/0/a_m", Value::from("0.1")),
        ("robot", &base, "/tcp", serde_json::json!({ "xyz_m": [0.0, 0.0] })),
        ("robot", &base, "/tolerance", serde_json::json!({ "position": 1e-9 })),
        ("scenario", &scenario, "/controller/kind", Value::from("magic")),
        ("scenario", &scenario, "/check/0/kind", Value::from("aggreement")),
        ("scenario", &scenario, "/motion/0", serde_json::json!({ "move_joint_deg": {} })),
    ] {
        let mut document = document.clone();
        *document.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer}")) = wrong;
        assert!(!validator(name).is_valid(&document), "{pointer} is taken");
    }
}

#[test]
fn documents_follow_their_schemas() {
    let at = "--at=elbow_joint=1.2rad";
    let folder = tempfile::tempdir().unwrap();
    let targets = folder.path().join("targets.json");
    fs::write(&targets, r#"[{"translation_m": [0.7, 0.2, 0]}, {"translation_m": [1.5, 0, 0]}]"#).unwrap();
    let targets = text(&targets);
    let configurations = folder.path().join("configurations.json");
    fs::write(&configurations, r#"[{"q": {"joint_1": 0.5}}]"#).unwrap();
    let configurations = text(&configurations);
    let [robot, scenario] = ["robot", "scenario.toml"].map(|name| text(&folder.path().join(name)));
    let commands: &[(&str, &[&str])] = &[
        ("check", &["check", "robots/ur5e"]),
        ("check", &["check", "robots/cylindrical_rpp"]),
        ("check", &["check", "robots/planar_2r", "--configurations", &configurations]),
        (
            "measured_check",
            &[
                "check",
                "robots/ur5e",
                "--measurements",
                "docs/examples/calibration/ur5e_points.csv",
                "--tolerance=5mm",
            ],
        ),
        (
            "same_point",
            &["calibrate", "robots/ur5e", "--same-point", "docs/examples/calibration/ur5e_hole_1.csv"],
        ),
        ("describe", &["describe", "robots/panda"]),
        ("describe", &["describe", "robots/rrr_arm/rrr_arm.urdf"]),
        ("log", &["describe", "docs/examples/log/joints.csv", "--robot", "robots/ur5e"]),
        ("acm", &["clearance", "robots/rrr_arm", "--samples", "100", "--write-srdf", "-"]),
        ("new_robot", &["new", "robot", "robots/ur5e/ur5e.urdf", "--out", &robot]),
        ("new_scenario", &["new", "scenario", "robots/planar_2r", "--to", &scenario]),
        ("fk", &["fk", "robots/ur5e", at]),
        ("fk", &["fk", "robots/ur5e", "--from", "tool0", "--to", "forearm_link"]),
        ("dynamics", &["dynamics", "robots/ur5e", "--payload", "2.5", at]),
        ("jacobian", &["jacobian", "robots/ur5e", at]),
        ("ik", &["ik", "robots/planar_2r", "--targets", &targets]),
        ("manipulability", &["manipulability", "robots/panda"]),
        ("workspace", &["workspace", "robots/rrr_arm"]),
        ("sensitivity", &["sensitivity", "robots/rrr_arm"]),
        ("tolerances", &["tolerances", "robots/rrr_arm", "--a=1mm", "--tolerance=1mm,1deg", "--random=20"]),
        ("tolerances", &["tolerances", "robots/ur5e", "--digits", "--samples=2000", at]),
        ("clearance", &["clearance", "robots/ur5e", at]),
        ("convert", &["convert", "robots/ur5e", "--to", "modified"]),
        ("convert", &["convert", "robots/ur5e", "--from", "urdf", "--to", "standard"]),
        ("convert", &["convert", "robots/ur5e", "--to", "mjcf"]),
    ];
    for (name, arguments) in commands {
        let answer = congruent_json(arguments);
        assert!(answer.code <= 1, "{arguments:?}: {}", answer.stderr);
        follows(name, &arguments.join(" "), &answer.json());
    }
}

#[test]
fn reports_and_recordings_follow_their_schemas() {
    let folder = tempfile::tempdir().unwrap();
    for scenario in ["ur5e_pick", "ur5e_wrong_convention", "rrr_arm_servo", "ur5e_into_table"] {
        let file = format!("scenarios/{scenario}.toml");
        let answer = congruent_json(&["run", &file, "--out", &text(folder.path())]);
        follows("report", &file, &answer.json());
        let written = fs::read_to_string(folder.path().join(scenario).join("report.json")).unwrap();
        follows("report", &format!("report.json of {file}"), &serde_json::from_str(&written).unwrap());
        let recording = folder.path().join(scenario).join("recording.rrd");
        if cfg!(feature = "recording") {
            let recording = text(&recording);
            follows("inspect", &file, &congruent_json(&["inspect", &recording]).json());
            let checked = congruent_json(&["inspect", &recording, "--check", &file]).json();
            assert!(checked["recheck"].is_object(), "{file}");
            follows("inspect", &format!("--check {file}"), &checked);
        }
    }
}

#[cfg(feature = "recording")]
#[test]
fn a_robot_that_is_viewed_follows_its_schema() {
    let folder = tempfile::tempdir().unwrap();
    for robot in ["robots/rrr_arm", "robots/cylindrical_rpp"] {
        let answer = congruent_json(&["view", robot, "--no-viewer", "--out", &text(folder.path())]);
        follows("view", robot, &answer.json());
    }
}

#[test]
fn an_unknown_schema_is_named_with_the_nearest() {
    let answer = congruent(&["schema", "scenari"]);
    assert_eq!(answer.code, 2);
    assert!(answer.stderr.contains("did you mean \"scenario\"?"), "{}", answer.stderr);
}
