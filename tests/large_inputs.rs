//! Long lists of configurations in little memory.

use std::{
    fmt::Write,
    fs::{self, File},
};

use crate::{calibration::Bench, command::with_memory};

const CONFIGURATIONS: usize = 200_000;
/// Address space of the command, in KiB. Of it the program has 60 MB before it reads anything, and the values of the joints
/// 10 MB; each configuration in a form of its own would take 100 MB or more.
const MOST_KIB: u32 = 128 << 10;

/// A list of configurations of the UR5e, each another one.
fn list() -> String {
    let joints = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    let mut text = String::from("[\n");
    for at in 0..CONFIGURATIONS {
        let comma = if at == 0 { "" } else { ",\n" };
        let _ = write!(text, "{comma}{{\"q\": {{");
        for (index, joint) in joints.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            let thousandths = at * (index + 3) % 1000;
            let _ = write!(text, "{comma}\"{joint}_joint\": 0.{thousandths:03}");
        }
        text += "}}";
    }
    text + "\n]\n"
}

/// What the command prints if it has no more memory than this.
fn limited(bench: &Bench, arguments: &[&str]) -> String {
    let printed = bench.write("printed", "");
    let mut command = with_memory(MOST_KIB, arguments);
    let ended = command.stdout(File::create(&printed).unwrap()).output().unwrap();
    assert!(ended.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ended.stderr));
    fs::read_to_string(printed).unwrap()
}

#[test]
fn memory_is_that_of_the_joint_values_however_many_configurations() {
    let bench = Bench::new();
    let list = bench.write("list.json", &list());
    for (command, options, entry) in [
        ("fk", &["--to", "tool0"][..], "\"links\":"),
        ("manipulability", &[], "\"tcp_in_base_m\":"),
        ("jacobian", &[], "\"angular\":"),
    ] {
        let arguments = [&[command, "robots/ur5e", "--configurations", &list], options].concat();
        let json = limited(&bench, &[&arguments[..], &["--format", "json"]].concat());
        assert_eq!(json.matches(entry).count(), CONFIGURATIONS, "{command}");
        let text = limited(&bench, &arguments);
        assert_eq!(text.matches("configuration ").count(), CONFIGURATIONS, "{command}");
    }
}
