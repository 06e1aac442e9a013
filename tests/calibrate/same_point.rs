//! `calibrate --same-point`: two holes that a UR5e with known zeros has touched, by a program of their own, to 0.05 mm.

use crate::support::{
    command::{congruent, congruent_json, text},
    golden::number,
    scratch_folder::ScratchFolder,
};

const HOLES: [&str; 2] =
    ["docs/examples/calibration/ur5e_hole_1.csv", "docs/examples/calibration/ur5e_hole_2.csv"];

/// The zeros with which the examples were made, deg.
const ZEROS_DEG: [(&str, f64); 4] = [
    ("shoulder_lift_joint.zero", 0.35),
    ("elbow_joint.zero", -0.22),
    ("wrist_1_joint.zero", 0.1),
    ("wrist_2_joint.zero", 0.18),
];

#[test]
fn touched_holes_give_the_zeros_that_they_were_made_with() {
    let answer = congruent_json(&[&["calibrate", "robots/ur5e", "--same-point"], &HOLES[..]].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!((&report["verdict"], &report["rows"]), (&"explained".into(), &48.into()));
    let parameters = report["parameters"].as_array().unwrap();
    assert_eq!(parameters.len(), ZEROS_DEG.len(), "{parameters:?}");
    for (each, (name, truth_deg)) in parameters.iter().zip(ZEROS_DEG) {
        assert_eq!(each["name"], name);
        let off = number(&each["correction"]) - truth_deg.to_radians();
        // Three standard deviations: 99.7 % of normal noise.
        assert!(off.abs() < 3.0 * number(&each["standard_deviation"]), "{each}");
    }
    // Three coordinates with 0.05 mm each are 0.08 mm in the mean.
    assert!(number(&report["held_out"]["mean_m"]) < 1e-4, "{}", report["held_out"]);
    let printed = congruent(&[&["calibrate", "robots/ur5e", "--same-point"], &HOLES[..]].concat()).stdout;
    assert!(printed.contains("corrected, held out") && printed.contains("ur5e_hole_2.csv"), "{printed}");
}

#[test]
fn the_written_robot_needs_no_further_correction() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("calibrated"));
    let robot = format!("{out}/robot.toml");
    let written =
        congruent(&[&["calibrate", "robots/ur5e", "--out", &out, "--same-point"], &HOLES[..]].concat());
    assert_eq!(written.code, 0, "{}{}", written.stdout, written.stderr);
    assert!(written.stdout.contains("robot.toml: the corrected table"), "{}", written.stdout);
    assert_eq!(congruent(&["check", &robot]).code, 0);
    let again = congruent_json(&[&["calibrate", &robot, "--same-point"], &HOLES[..]].concat()).json();
    for each in again["parameters"].as_array().unwrap() {
        assert!(number(&each["correction"]).abs() < 1e-9, "{each}");
    }
    // The same rows again: no better than themselves, so there is nothing to write.
    let other = text(&scratch.path().join("other"));
    let nothing = congruent(&[&["calibrate", &robot, "--out", &other, "--same-point"], &HOLES[..]].concat());
    assert_eq!(nothing.code, 1, "{}{}", nothing.stdout, nothing.stderr);
    assert!(nothing.stdout.contains("nothing is written to"), "{}", nothing.stdout);
}

#[test]
fn points_take_the_place_of_measurements() {
    let points = "docs/examples/calibration/ur5e_points.csv";
    let both = congruent(&["calibrate", "robots/ur5e", points, "--same-point", HOLES[0]]);
    assert_eq!(both.code, 2, "{}", both.stderr);
    let neither = congruent(&["calibrate", "robots/ur5e"]);
    assert!(neither.code == 2 && neither.stderr.contains("MEASUREMENTS"), "{}", neither.stderr);
}
