//! What `congruent check` suggests, put into the file, makes the models agree; under a loose tolerance
//! the exact cause is named; and what is said about it is true. First seen to fail on arms that an
//! outsider wrote.

use std::{
    f64::consts::{FRAC_PI_2, PI},
    fs,
};

use serde_json::Value;

use crate::support::{
    changed_robot::{Change, check_changed, first_cause, is_at_line, near},
    command::{Answer, congruent, congruent_json, text},
};

/// Tolerance of the file that suggestions are held to: they are as exact as a fit.
const SUGGESTED: &str = "[tolerance]\nposition_m = 1e-12\norientation_rad = 1e-12\n";

/// A small arm whose tool the URDF turns by `rpy`.
fn urdf(rpy: [f64; 3]) -> String {
    let joint = |number: usize, origin: &str| {
        let (parent, child) = (number - 1, number);
        format!(
            "<joint name=\"joint_{number}\" type=\"revolute\"><parent link=\"link_{parent}\"/><child link=\"link_{child}\"/>\
             {origin}<axis xyz=\"0 0 1\"/><limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>\n"
        )
    };
    let links =
        ["link_0", "link_1", "link_2", "link_3"].map(|name| format!("<link name=\"{name}\"/>\n")).concat();
    let [roll, pitch, yaw] = rpy;
    format!(
        "<robot name=\"arm\">\n{links}<link name=\"tip\"/>\n{}{}{}\
         <joint name=\"tool\" type=\"fixed\"><parent link=\"link_3\"/><child link=\"tip\"/>\
         <origin xyz=\"0.1 0 0.12\" rpy=\"{roll:?} {pitch:?} {yaw:?}\"/></joint>\n</robot>\n",
        joint(1, ""),
        joint(2, "<origin xyz=\"0.3 0 0.2\" rpy=\"0.9 0 0\"/>"),
        joint(3, "<origin xyz=\"0.25 0 0\" rpy=\"-1.1 0 0\"/>"),
    )
}

/// Its table, with a declared tool as `tool` writes it at the end.
fn robot_file(tool: &str) -> String {
    let row = |joint: usize, figures: &str| {
        format!("  {{ joint = \"joint_{joint}\", kind = \"revolute\", {figures} }},\n")
    };
    format!(
        "name = \"arm\"\nurdf = \"arm.urdf\"\nbase = \"link_0\"\ntip = \"tip\"\n{SUGGESTED}[dh]\nconvention = \"standard\"\n\
         row = [\n{}{}{}]\n{tool}\n",
        row(1, "a_mm = 300, alpha_rad = 0.9, d_mm = 200"),
        row(2, "a_mm = 250, alpha_rad = -1.1, d_mm = 0"),
        row(3, "a_mm = 0, alpha_rad = 0, d_mm = 0"),
    )
}

/// Puts the lines of a suggestion in the places that the report says.
fn apply(file: &str, cause: &Value) -> String {
    let mut lines: Vec<&str> = file.lines().collect();
    let changes = cause["changes"].as_array().unwrap();
    assert!(!changes.is_empty(), "{cause}");
    for change in changes.iter().rev() {
        let line = |key: &str| usize::try_from(change[key].as_u64().unwrap()).unwrap();
        lines.splice(line("from_line") - 1..line("to_line"), [change["text"].as_str().unwrap()]);
    }
    lines.join("\n") + "\n"
}

/// The first of the equal explanations that has this cause and, unless it is empty, this joint.
#[track_caller]
fn find(answer: &Answer, cause: &str, joint: &str) -> Value {
    first_cause(answer);
    let report = answer.json();
    let equal = report["indistinguishable"].as_array().unwrap();
    let is_it = |it: &&Value| it["cause"] == cause && (joint.is_empty() || it["joint"] == joint);
    let mut all = [&report["diagnosis"][0]].into_iter().chain(equal);
    all.find(is_it).unwrap_or_else(|| panic!("no {cause} {joint} in {report}")).clone()
}

/// A wrong tool in some form, and the right one as the URDF has it: the suggestion is exact.
#[track_caller]
fn suggestion_agrees(rpy: [f64; 3], tool: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    fs::write(folder.path().join("arm.urdf"), urdf(rpy)).unwrap();
    let file = robot_file(tool);
    fs::write(&path, &file).unwrap();
    let cause = find(&congruent_json(&["check", &text(&path)]), "tool", "");
    let corrected = apply(&file, &cause);
    fs::write(&path, &corrected).unwrap();
    let answer = congruent_json(&["check", &text(&path)]);
    assert_eq!(
        answer.code, 0,
        "{rpy:?}: {}\n{corrected}\n{}{}",
        cause["suggestion"], answer.stdout, answer.stderr
    );
}

#[test]
fn suggested_transforms_are_exact_where_roll_and_yaw_are_one() {
    for (roll, pitch, yaw) in [
        (0.0, FRAC_PI_2, 0.0),
        (0.0, -FRAC_PI_2, 0.0),
        (0.7, -FRAC_PI_2, -1.9),
        (2.9, FRAC_PI_2 - 1e-9, 0.4),
        (-1.3, 2e-8 - FRAC_PI_2, 3.0),
        (0.3, FRAC_PI_2 + 1e-12, 0.2),
        (PI, 0.0, PI),
        (-2.1, 1.3, 0.8),
    ] {
        for tool in ["rpy_deg = [3, -92, 5]", "rpy_rad = [0.1, 0.2, 0.3]"] {
            let tool = format!("dhn_from_tip = {{ xyz_m = [0.11, 0.02, 0.09], {tool} }}");
            suggestion_agrees([roll, pitch, yaw], &tool);
        }
    }
}

#[test]
fn suggested_transforms_are_written_as_the_file_writes_them() {
    for tool in [
        "",
        "dhn_from_tip = {}",
        "dhn_from_tip = { xyz_mm = [100, 20, 120], rpy_deg = [0, 10, 0] }",
        "dhn_from_tip = { quaternion_wxyz = [0.6, 0, 0.8, 0] }",
        "dhn_from_tip = { matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]] }",
        "dhn_from_tip.xyz_mm = [0, 0, 5]",
        "[dh.dhn_from_tip]",
        "[dh.dhn_from_tip]\nxyz_mm = [0, 0, 5]\nrpy_deg = [0, 0, 30]",
        "[dh.dhn_from_tip]\nquaternion_wxyz = [0.6, 0, 0.8, 0]\nxyz_m = [1, 2, 3]",
    ] {
        suggestion_agrees([0.4, -FRAC_PI_2, 0.3], tool);
    }
}

#[test]
fn suggestions_keep_the_units_of_the_file() {
    let tool = "dhn_from_tip = { xyz_mm = [0.0, 0.0, 5.0], rpy_deg = [0.0, 0.0, 0.0] }";
    let (answer, file) = check_changed("ur5e", &[("", "dhn_from_tip = {}", tool)]);
    let cause = first_cause(&answer);
    assert_eq!(cause["suggestion"], "dhn_from_tip = { xyz_mm = [0, 0, 0], rpy_deg = [0, 0, 0] }");
    is_at_line(&cause, &file, tool);
}

/// The tolerance of `ur5e` and others, and one that a half degree just exceeds.
const LOOSE: [Change<'_>; 2] = [
    ("", "position_m = 1e-12", "position_m = 1e-3"),
    ("", "orientation_rad = 1e-12", "orientation_rad = 1e-3"),
];

/// Checks a robot after a change, under a tolerance of a millimetre and a milliradian.
#[track_caller]
fn loosely(robot: &str, change: Change<'_>) -> Value {
    let (answer, _) = check_changed(robot, &[change, LOOSE[0], LOOSE[1]]);
    first_cause(&answer);
    answer.json()
}

/// Of explanations within the tolerance the exact one is named, although a mistake of a unit that makes
/// the wrong figure small has no free number.
#[test]
fn a_loose_tolerance_does_not_hide_the_exact_cause() {
    let tool = "dhn_from_tip = { xyz_m = [0.0, 0.0, 0.005] }";
    let report = loosely("ur5e", ("", "dhn_from_tip = {}", tool));
    let cause = &report["diagnosis"][0];
    assert_eq!(cause["cause"], "tool");
    near(&cause["translation_m"][2], 0.005);
    near(&cause["residual_m"], 0.0);

    let report = loosely("ur5e", ("shoulder_pan_joint", "theta_deg = 0.0", "theta_deg = 0.5"));
    let cause = &report["diagnosis"][0];
    assert_eq!([&cause["cause"], &cause["joint"]], ["zero_offset", "shoulder_pan_joint"]);
    near(&cause["expected"], 0.0);

    let report = loosely("ur5e", ("wrist_2_joint", "a_m = 0.0", "a_m = 0.05"));
    let cause = &report["diagnosis"][0];
    assert_eq!([&cause["cause"], &cause["parameter"]], ["parameter", "a"]);
    near(&cause["expected"], 0.0);
    // The length in millimetres would leave 0.05 mm, which is within the tolerance.
    near(&cause["residual_m"], 0.0);
}

/// A true mistake of a unit is named as such under a loose tolerance too.
#[test]
fn a_loose_tolerance_does_not_hide_a_mistake_of_a_unit() {
    let report = loosely("panda", ("panda_joint4", "a_m = 0.0825", "a_m = 82.5"));
    assert_eq!(report["diagnosis"][0]["cause"], "millimetres_as_metres");
}

#[test]
fn reasons_are_those_of_the_two_parameters() {
    let parallel = "only the sum of the offsets along parallel axes matters";
    let behind = "a transform behind the last joint can be in the joint's row or in the tool";
    let before = "a transform before the first joint can be in the base or in the joint's row";
    // The three parallel axes of a UR: its offsets add up.
    let (answer, _) = check_changed("ur5e", &[("elbow_joint", "d_m = 0.0", "d_m = 0.01")]);
    assert_eq!(find(&answer, "parameter", "wrist_1_joint")["reason"], parallel);
    // Twists, and offsets along axes that are not parallel, are no such sum.
    let (answer, _) = check_changed("ur5e", &[("wrist_3_joint", "alpha_deg = 0.0", "alpha_deg = 4.0")]);
    assert_eq!(find(&answer, "tool", "")["reason"], behind);
    let (answer, _) = check_changed("ur5e", &[("wrist_3_joint", "theta_deg = 0.0", "theta_deg = 4.0")]);
    assert_eq!(find(&answer, "tool", "")["reason"], behind);
    let (answer, _) = check_changed("ur5e", &[("shoulder_pan_joint", "theta_deg = 0.0", "theta_deg = 4.0")]);
    assert_eq!(find(&answer, "base", "")["reason"], before);
}

#[test]
fn what_is_not_written_has_a_place_too() {
    let (answer, file) = check_changed("rrr_arm", &[("joint_2", "theta_deg = 90.0\n", "")]);
    let cause = find(&answer, "zero_offset", "joint_2");
    assert_eq!(cause["suggestion"], "theta_deg = 90");
    is_at_line(&cause, &file, "joint = \"joint_2\"");
    let printed = congruent(&["check", "robots/ur5e"]).stdout;
    assert!(!printed.contains("expected"));

    let empty = "base_from_dh0 = {  }";
    let (answer, file) = check_changed(
        "ur5e",
        &[("", "base_from_dh0 = { rpy_deg = [0, 0, 180] }", empty), ("", "dhn_from_tip = {}\n", "")],
    );
    let base = find(&answer, "base", "");
    is_at_line(&base, &file, empty);
    assert_eq!(base["suggestion"], "base_from_dh0 = { rpy_deg = [0, 0, 180] }");

    let (answer, file) = check_changed(
        "panda",
        &[("panda_joint7", "a_m = 0.088", "a_m = 0.0"), ("panda_joint7", "d_m = 0.0", "d_m = 0.088")],
    );
    let cause = first_cause(&answer);
    assert_eq!(cause["suggestion"], "a_m = 0.088\nd_m = 0");
    let line = usize::try_from(cause["line"].as_u64().unwrap()).unwrap();
    assert_eq!(file.lines().nth(line - 1), Some("a_m = 0.0"));
}

#[test]
fn a_wrong_kind_is_called_so() {
    let (answer, file) = check_changed("cylindrical_rpp", &[("joint_2", "\"prismatic\"", "\"revolute\"")]);
    let cause = first_cause(&answer);
    assert_eq!([&cause["cause"], &cause["joint"], &cause["parameter"]], ["parameter", "joint_2", "kind"]);
    assert_eq!([&cause["found"], &cause["expected"]], ["revolute", "prismatic"]);
    assert_eq!(cause["suggestion"], "kind = \"prismatic\"");
    is_at_line(&cause, &file, "kind = \"revolute\"");
}

#[test]
fn the_offset_that_a_joint_drives_is_a_parameter_too() {
    let (answer, _) = check_changed("cylindrical_rpp", &[("joint_2", "d_m = 0.0", "d_m = 0.07")]);
    assert_eq!(first_cause(&answer)["cause"], "zero_offset");
    assert_eq!(find(&answer, "parameter", "joint_2")["reason"], "the corrected values are the same");
}

/// A turn of the tool by quarter turns, which some other order of a URDF's angles gives as well.
#[test]
fn a_fault_of_the_table_ranks_before_the_order_of_the_urdf() {
    let rpy = [PI, 0.0, PI];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    fs::write(folder.path().join("arm.urdf"), urdf(rpy)).unwrap();
    fs::write(&path, robot_file("dhn_from_tip = { xyz_m = [0.1, 0, 0.12], rpy_deg = [180, 0, 0] }")).unwrap();
    let answer = congruent_json(&["check", &text(&path)]);
    let cause = first_cause(&answer);
    assert_eq!(cause["cause"], "tool", "{cause}");
}

/// Such a table was "certified below inf m".
#[test]
fn a_value_beyond_meaning_is_refused_at_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.toml");
    fs::write(folder.path().join("arm.urdf"), urdf([0.0; 3])).unwrap();
    for (constants, limit) in [
        ("base_from_dh0 = { rpy_rad = [1e308, 0, 0] }", "limit <= 1e6 rad"),
        ("dhn_from_tip = { xyz_m = [0.1, 0, 1e200] }", "limit <= 1e6 m"),
    ] {
        fs::write(&path, robot_file(constants)).unwrap();
        let answer = congruent_json(&["check", &text(&path)]);
        let document = answer.json();
        let findings = document["findings"].as_array().unwrap();
        let finding =
            findings.iter().find(|finding| finding["code"] == "toml::too_large").expect("it is refused");
        assert!(answer.code == 2 && finding["line"].is_u64(), "{finding}");
        assert!(finding["message"].as_str().unwrap().contains(limit), "{finding}");
    }
}
