//! Long lists of configurations in little memory.

use std::{
    fmt::Write,
    fs::{self, File},
};

use crate::support::{command::with_memory, scratch_folder::ScratchFolder};

/// Address space of the command, in KiB. Of it the program has 60 MB before it reads anything; the joint values of 200,000
/// configurations take 10 MB. With a form of its own for each configuration every one of these calls takes more.
const MOST_KIB: u32 = 128 << 10;

/// Configurations of the UR5e, one per line.
fn lines(configurations: usize) -> String {
    let joints = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    let mut text = String::new();
    for at in 0..configurations {
        text += "{\"q\": {";
        for (index, joint) in joints.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            let thousandths = at * (index + 3) % 1000;
            let _ = write!(text, "{comma}\"{joint}_joint\": 0.{thousandths:03}");
        }
        text += "}}\n";
    }
    text
}

/// What the command prints if it has no more memory than this.
fn limited(scratch: &ScratchFolder, arguments: &[&str]) -> String {
    let printed = scratch.write("printed", "");
    let mut command = with_memory(MOST_KIB, arguments);
    let ended = command.stdout(File::create(&printed).unwrap()).output().unwrap();
    assert!(ended.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ended.stderr));
    fs::read_to_string(printed).unwrap()
}

#[test]
fn memory_is_that_of_the_joint_values_however_many_configurations() {
    let scratch = ScratchFolder::new();
    let check = |configurations: usize, arguments: &[&str], entry: &str| {
        let list = scratch.write("list.jsonl", &lines(configurations));
        let (command, options) = arguments.split_first().unwrap();
        let all = [&[command, "robots/ur5e", "--configurations", &list], options].concat();
        let printed = limited(&scratch, &all);
        assert_eq!(printed.matches(entry).count(), configurations, "{arguments:?}");
    };
    check(200_000, &["fk", "--to", "tool0"], "configuration ");
    check(200_000, &["fk", "--to", "tool0", "--format", "json"], "\"links\":");
    check(200_000, &["jacobian", "--format", "json"], "\"angular\":");
    check(200_000, &["dynamics", "--format", "json"], "\"bias_n_m\":");
    check(200_000, &["check", "--format", "json"], "\"tip\":[");
    check(200_000, &["check"], "at configuration ");
    check(
        20_000,
        &["clearance", "--pair", "forearm_link,*", "--limit", "1mm", "--format", "json"],
        "\"distances_m\":",
    );
    // Ellipsoids take ten times as long.
    check(50_000, &["manipulability", "--format", "json"], "\"tcp_in_base_m\":");
}
