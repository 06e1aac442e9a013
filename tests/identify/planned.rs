//! `plan`: its motion stays within the limits, and the physics that follows it shows what it promised.

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
    scratch_folder::ScratchFolder,
};

#[test]
fn the_friction_of_the_physics_is_found_from_the_planned_motion() {
    let scratch = ScratchFolder::new();
    for robot in ["rrr_arm", "panda"] {
        let folder = text(&scratch.path().join(robot));
        let robot = format!("robots/{robot}");
        let planned = congruent_json(&["plan", &robot, "--out", &folder, "--duration-s", "8"]);
        assert_eq!(planned.code, 0, "{}", planned.stderr);
        assert!(number(&planned.json()["nearest_m"]) >= 0.02, "{}", planned.stdout);
        let scenario = format!("{folder}/identification.toml");
        let out = format!("{folder}/out");
        let changes =
            ["--set", "joints.friction=0.4", "--set", "joints.damping=0.9", "--set", "joints.armature=0.02"];
        let run = congruent(&[&["run", &scenario, "--out", &out, "--no-recording"], &changes[..]].concat());
        assert_eq!(run.code, 0, "{}{}", run.stdout, run.stderr);
        let log = format!("{out}/identification/trajectory.mcap");
        let report = congruent_json(&["identify", &robot, &log]).json();
        assert_eq!(report["verdict"], "better", "{report}");
        let joints = report["joints"].as_array().unwrap();
        for joint in joints.iter().filter(|joint| joint["unit"] == "N m") {
            for of in joint["terms"].as_array().unwrap() {
                let truth = match of["term"].as_str().unwrap() {
                    "viscous" => 0.9,
                    "coulomb" => 0.4,
                    "armature" => 0.02,
                    _ => 0.0,
                };
                // The physics rounds the step of friction at zero velocity.
                let off = (number(&of["value"]) - truth).abs();
                assert!(
                    off < 0.05_f64.max(4.0 * number(&of["standard_error"])),
                    "{robot} {}: {of}",
                    joint["joint"]
                );
            }
        }
    }
}

#[test]
fn a_motion_without_room_is_refused() {
    let scratch = ScratchFolder::new();
    let folder = text(&scratch.path().join("narrow"));
    let refused = congruent(&["plan", "robots/ur5e", "--out", &folder, "--clearance", "2m"]);
    assert_eq!(refused.code, 2, "{}", refused.stdout);
    assert!(
        refused.stderr.contains("CGR-COMMAND-104") && refused.stderr.contains("--clearance"),
        "{}",
        refused.stderr
    );
    assert!(!scratch.path().join("narrow").exists());
}
