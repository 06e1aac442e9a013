//! `[[inertial]]` entries and tables that are typed with fewer digits than the URDF: rounding is no difference of `check`, and what a run
//! says of it.

use std::fs;

use crate::support::{
    command::{congruent, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// So that the digits decide.
const WITHOUT_TOLERANCE: (&str, &str) = ("[tolerance]\nposition_m = 1e-12\norientation_rad = 1e-12", "");

/// The UR5e of the project with these replacements in its robot file.
fn ur5e(scratch: &ScratchFolder, replaced: &[(&str, &str)]) -> String {
    let folder = workspace().join("robots/ur5e");
    let urdf = format!("urdf = \"{}\"", text(&folder.join("ur5e.urdf")));
    let mut robot =
        fs::read_to_string(folder.join("robot.toml")).unwrap().replace("urdf = \"ur5e.urdf\"", &urdf);
    for (from, to) in replaced {
        assert!(robot.contains(from), "{from}");
        robot = robot.replace(from, to);
    }
    scratch.write("robot.toml", &robot)
}

#[test]
fn declared_masses_are_judged_by_their_digits() {
    let scratch = ScratchFolder::new();
    let rounded = [("mass_kg = 8.058", "mass_kg = 8.06"), ("[0, 0, -0.001159]", "[0, 0, -0.0012]")];
    let path = ur5e(&scratch, &rounded);
    let answer = congruent(&["check", &path]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    let found = "rounded: 2 values of masses, inertias and limits";
    assert!(
        answer.stdout.contains(": SAME ROBOT within the digits written, INERTIA NOT COMPARED"),
        "{}",
        answer.stdout
    );
    assert!(
        answer.stdout.contains(found)
            && answer.stdout.contains("upper_arm_link: mass, wrist_3_link: centre of mass"),
        "{}",
        answer.stdout
    );
    // Beyond half of the last place.
    for wrong in [("mass_kg = 8.058", "mass_kg = 8.07"), ("[0, 0, -0.001159]", "[0, 0, -0.0013]")] {
        let answer = congruent(&["check", "-q", &ur5e(&scratch, &[wrong])]);
        assert_eq!(answer.code, 1, "{}", answer.stdout);
        assert!(answer.stdout.contains("SAME GEOMETRY, DIFFERENT DYNAMICS"), "{}", answer.stdout);
    }
}

/// A rounded table moves the frames in which masses are declared, which is no other mass. A run, which does not judge by digits, says so.
#[test]
fn a_rounded_table_moves_declared_masses_and_fails_a_run() {
    let scratch = ScratchFolder::new();
    let path = ur5e(&scratch, &[WITHOUT_TOLERANCE, ("-0.3922", "-0.392"), ("0.1625", "0.163")]);
    let answer = congruent(&["check", &path]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert!(
        answer.stdout.contains(": SAME ROBOT within the digits written (up to 0.7 mm apart"),
        "{}",
        answer.stdout
    );
    assert!(
        answer.stdout.contains("6 values of masses, inertias, limits and losses are equal within the digits"),
        "{}",
        answer.stdout
    );
    let scenario = fs::read_to_string(workspace().join("scenarios/ur5e_pick.toml")).unwrap();
    let scenario = scratch.write("pick.toml", &scenario.replace("\"../robots/ur5e\"", "\"robot.toml\""));
    let answer =
        congruent(&["run", &scenario, "--no-recording", "--out", &text(&scratch.path().join("out"))]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let note =
        "table and URDF differ by rounding alone, by which a run does not judge: declare in robot.toml";
    assert!(answer.stdout.contains(note), "{}", answer.stdout);
}
