//! What is suspicious about an input is in the document of every command, and on standard error in every format.

use serde_json::Value;

use crate::support::{
    command::{congruent, text},
    scratch_folder::ScratchFolder,
};

/// A mesh that is not there: a warning for every command that does without.
const MESH: &str = "<link name=\"tip\"><visual><geometry><mesh filename=\"none.stl\"/></geometry></visual>";

const SCENARIO: &str = "schema_version = 1\nname = \"still\"\nrobot = \"planar_2r\"\n[simulation]\nduration_s = 0.01\n\
                        [controller]\nkind = \"gravity_compensation\"\n[[check]]\nkind = \"agreement\"\n";

/// Every command that reads a robot; names of files are those of the scratch folder.
const COMMANDS: [&[&str]; 19] = [
    &["run", "scenario.toml", "--no-recording", "--out", "out"],
    &["run", "--faults", "scenario.toml"],
    &["check", "planar_2r"],
    &["check", "planar_2r", "--configurations", "configurations.json"],
    &["describe", "planar_2r"],
    &["fk", "planar_2r"],
    &["fk", "planar_2r", "--configurations", "configurations.json"],
    &["jacobian", "planar_2r"],
    &["ik", "planar_2r", "--targets", "targets.json"],
    &["dynamics", "planar_2r"],
    &["manipulability", "planar_2r"],
    &["workspace", "planar_2r"],
    &["sensitivity", "planar_2r"],
    &["tolerances", "planar_2r", "--a=1mm"],
    &["calibrate", "planar_2r", "measured.csv"],
    &["convert", "planar_2r", "--from", "urdf", "--to", "standard"],
    &["dynamics", "planar_2r", "--base-parameters"],
    &["convert", "planar_2r", "--to", "poe"],
    &["new", "scenario", "planar_2r", "--to", "new.toml"],
];

fn scratch_folder() -> ScratchFolder {
    let scratch = ScratchFolder::new();
    scratch.robot("planar_2r", &[]);
    let urdf = scratch.path().join("planar_2r/planar_2r.urdf");
    let before = std::fs::read_to_string(&urdf).unwrap();
    assert!(before.contains("<link name=\"tip\""), "{before}");
    let after = before.replace("<link name=\"tip\"/>", &format!("{MESH}</link>"));
    assert!(after.contains(MESH), "{before}");
    std::fs::write(urdf, after).unwrap();
    scratch.write("scenario.toml", SCENARIO);
    scratch.write("configurations.json", "[{\"q\": {\"joint_1\": 99.0}}]");
    scratch
        .write("targets.json", "[{\"translation_m\": [0.7, 0.5, 0.0], \"quaternion_wxyz\": [1, 0, 0, 0]}]");
    scratch.write(
        "measured.csv",
        "joint_1_rad,joint_2_rad,x_m,y_m\n0,0,1,0\n1,1,0.2,0.9\n2,1,-0.6,0.6\n0,1,0.8,0.3\n",
    );
    scratch
}

/// All strings `message` in lists `warnings`, of any depth.
fn messages(document: &Value) -> Vec<String> {
    match document {
        Value::Object(fields) => {
            let own = fields.get("warnings").and_then(Value::as_array).into_iter().flatten();
            let own = own.filter_map(|warning| Some(warning.get("message")?.as_str()?.to_owned()));
            own.chain(fields.values().flat_map(messages)).collect()
        }
        Value::Array(entries) => entries.iter().flat_map(messages).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn every_command_warns_in_every_format() {
    for command in COMMANDS {
        let scratch = scratch_folder();
        let is_file = |name: &str| name.contains('.') || name == "out" || name == "planar_2r";
        let path =
            |name: &&str| if is_file(name) { text(&scratch.path().join(name)) } else { (*name).to_owned() };
        let mut arguments: Vec<String> = command.iter().map(path).collect();
        if arguments[0] == "new" {
            arguments.push("--force".to_owned());
        }
        let mut expected = vec!["none.stl"];
        if command.contains(&"configurations.json") {
            expected.push("joint_1");
        }
        let human = congruent(&arguments);
        arguments.extend(["--format".to_owned(), "json".to_owned()]);
        let json = congruent(&arguments);
        assert_eq!(human.code, json.code, "{command:?}: {human:?}");
        let found = messages(&json.json());
        for part in expected {
            // `check` has it below the answer, as a finding of lint.
            let printed = human.stderr.clone() + &human.stdout;
            assert!(printed.contains(part), "{command:?}: {printed}");
            assert!(json.stderr.contains(part), "{command:?}: {}", json.stderr);
            assert_eq!(
                found.iter().filter(|message| message.contains(part)).count(),
                1,
                "{command:?}: {found:?}"
            );
        }
    }
}
