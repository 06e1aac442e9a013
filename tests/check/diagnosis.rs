//! `congruent check` names what is wrong: faults written into robot files, and published tables whose
//! differences an independent study has found.

use std::fs;

use serde_json::Value;

use crate::support::{
    changed_robot::{Change, FITTED, check_changed, first_cause, is_at_line, near},
    command::{congruent, congruent_json, text},
    corpus::{corpus, workspace},
    published_table::{PANDA_JOINTS, Pairing, UR5E_JOINTS, check_table},
};

/// Reference case 7: which joint is at fault.
#[test]
fn case_07_names_the_joint_at_fault() {
    let (answer, file) = check_changed("spatial_3r", &[("joint_2", "theta_deg = 0.0", "theta_deg = 1.0")]);
    let cause = first_cause(&answer);
    assert_eq!(cause["cause"], "zero_offset");
    assert_eq!(cause["joint"], "joint_2");
    near(&cause["value"], 1_f64.to_radians());
    near(&cause["residual_m"], 0.0);
    near(&cause["residual_rad"], 0.0);
    is_at_line(&cause, &file, "theta_deg = 1.0");
    assert_eq!(cause["suggestion"], "theta_deg = 0");
}

/// Reference case 9: a table of one convention read as the other is recognised.
#[test]
fn case_09_recognises_a_table_read_under_the_other_convention() {
    for robot in ["ur5e", "panda"] {
        let cause =
            first_cause(&congruent_json(&["check", &format!("robots/{robot}/wrong_convention.toml")]));
        assert_eq!(cause["cause"], "convention_swapped");
        near(&cause["residual_m"], 0.0);
        let [found, expected] = [&cause["found"], &cause["expected"]];
        assert_eq!(*expected, if robot == "ur5e" { "standard" } else { "modified" });
        assert_ne!(found, expected);
    }
}

/// Reference case 11: the tool is separate from the chain, and what is not distinguishable from it is reported.
#[test]
fn case_11_distinguishes_the_tool_from_the_chain() {
    let answer = congruent_json(&["check", "robots/ur5e/tool_5mm_off.toml"]);
    let cause = first_cause(&answer);
    assert_eq!(cause["cause"], "tool");
    near(&cause["translation_m"][2], 0.005);
    let alike = &answer.json()["indistinguishable"][0];
    assert_eq!([&alike["cause"], &alike["joint"], &alike["parameter"]], ["parameter", "wrist_3_joint", "d"]);
}

/// Reference case 22: swapped joints are diagnosed.
#[test]
fn case_22_diagnoses_swapped_joints() {
    let changes = [
        ("joint_2", "joint_2", "joint_x"),
        ("joint_3", "joint_3", "joint_2"),
        ("joint_x", "joint_x", "joint_3"),
    ];
    let cause = first_cause(&check_changed("rrr_arm", &changes).0);
    assert_eq!(cause["cause"], "joints_swapped");
    assert_eq!(cause["joints"], serde_json::json!(["joint_3", "joint_2"]));
    near(&cause["residual_m"], 0.0);
}

#[test]
fn one_entry_is_named_with_its_line_and_what_should_stand_there() {
    let (answer, file) = check_changed("ur5e", &[("elbow_joint", "a_m = -0.3922", "a_m = -0.3822")]);
    let cause = first_cause(&answer);
    assert_eq!([&cause["cause"], &cause["joint"], &cause["parameter"]], ["parameter", "elbow_joint", "a"]);
    near(&cause["found"], -0.3822);
    near(&cause["expected"], -0.3922);
    is_at_line(&cause, &file, "a_m = -0.3822");
}

#[test]
fn mistakes_of_sign_unit_and_place_are_distinguished() {
    let cases: [(&str, &[Change<'_>], &str); 5] = [
        ("ur5e", &[("elbow_joint", "sign = 1", "sign = -1")], "axis_flipped"),
        ("ur5e", &[("shoulder_pan_joint", "alpha_deg = 90.0", "alpha_rad = 90.0")], "degrees_as_radians"),
        (
            "panda",
            &[("panda_joint2", "alpha_deg = -90.0", "alpha_deg = -1.5707963267948966")],
            "radians_as_degrees",
        ),
        ("panda", &[("panda_joint4", "a_m = 0.0825", "a_m = 82.5")], "millimetres_as_metres"),
        (
            "panda",
            &[("panda_joint7", "a_m = 0.088", "a_m = 0.0"), ("panda_joint7", "d_m = 0.0", "d_m = 0.088")],
            "parameters_exchanged",
        ),
    ];
    for (robot, changes, expected) in cases {
        let cause = first_cause(&check_changed(robot, changes).0);
        assert_eq!(cause["cause"], expected);
        near(&cause["residual_m"], 0.0);
    }
}

#[test]
fn a_fixed_joint_that_the_model_omits_is_named() {
    let (answer, _) =
        check_changed("panda", &[("", "dhn_from_tip = { xyz_m = [0.0, 0.0, 0.107] }", "dhn_from_tip = {}")]);
    let cause = first_cause(&answer);
    assert_eq!([&cause["cause"], &cause["joint"]], ["fixed_joint_dropped", "panda_joint8"]);
}

#[test]
fn two_faults_are_several() {
    let changes = [("elbow_joint", "sign = 1", "sign = -1"), ("wrist_1_joint", "d_m = 0.1333", "d_m = 0.13")];
    let cause = first_cause(&check_changed("ur5e", &changes).0);
    assert_eq!(cause["cause"], "several");
    let causes: Vec<&Value> = cause["parts"].as_array().unwrap().iter().map(|part| &part["cause"]).collect();
    assert_eq!(causes, ["axis_flipped", "parameter"]);
}

#[test]
fn physics_is_identified_as_a_black_box_with_the_same_answer() {
    let (answer, _) = check_changed("ur5e", &[("wrist_2_joint", "theta_deg = 0.0", "theta_deg = -7.0")]);
    let report = answer.json();
    let names: Vec<&Value> =
        report["diagnoses"].as_array().unwrap().iter().map(|pair| &pair["name"]).collect();
    assert_eq!(names, ["model_urdf", "model_simulation"]);
    for pair in report["diagnoses"].as_array().unwrap() {
        let cause = &pair["causes"][0];
        assert_eq!([&cause["cause"], &cause["joint"]], ["zero_offset", "wrist_2_joint"]);
        near(&cause["value"], -7_f64.to_radians());
    }
}

#[test]
fn people_see_the_line_at_fault() {
    let answer = congruent(&["check", "robots/ur5e/wrong_convention.toml"]);
    assert_eq!(answer.code, 1);
    for shown in ["check::convention_swapped", "wrong_convention.toml:8:14", "convention = \"standard\""] {
        assert!(answer.stdout.contains(shown), "{shown} is not in {}", answer.stdout);
    }
}

/// Published tables against published URDFs: what an independent study found, the diagnosis finds, except for
/// the rounding of the digits that both are typed with.
#[track_caller]
fn published(pairing: &Pairing<'_>) -> Option<Value> {
    let cause = first_cause(&check_table(pairing, &corpus()?));
    assert_eq!(cause["within_tolerance"], true, "{cause}");
    Some(cause)
}

/// Rounding alone is no cause; the nearest table shows which values are rounded.
#[track_caller]
fn only_rounded(pairing: &Pairing<'_>) {
    let Some(corpus) = corpus() else { return };
    let report = check_table(pairing, &corpus).json();
    assert_eq!([&report["verdict"], &report["grade"]], ["disagree", "same_within_digits"]);
    assert_eq!(report["diagnosis"], Value::Array(Vec::new()));
    let nearest = &report["diagnoses"][0]["table"];
    assert!(nearest["residual"]["position_m"].as_f64().unwrap() < FITTED, "{nearest}");
}

#[test]
fn panda_rtb_rounds_its_tool() {
    let (base, tip) = ("panda_link0", "panda_hand_tcp");
    only_rounded(&Pairing { table: "panda_rtb", urdf: "panda", base, tip, joints: &PANDA_JOINTS });
}

#[test]
fn xarm7_differs_by_quarter_turns_with_four_decimals_alone() {
    let joints = ["joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"];
    for table in ["xarm7_vendor_modified", "xarm7_vendor_standard"] {
        let pairing =
            Pairing { table, urdf: "xarm7_gripper", base: "world", tip: "link_eef", joints: &joints };
        only_rounded(&pairing);
    }
}

#[test]
fn baxter_differs_in_an_offset_and_the_base() {
    let joints = ["left_s0", "left_s1", "left_e0", "left_e1", "left_w0", "left_w1", "left_w2"];
    let pairing = Pairing {
        table: "baxter_left_rtb",
        urdf: "baxter",
        base: "base",
        tip: "left_gripper",
        joints: &joints,
    };
    let Some(cause) = published(&pairing) else { return };
    assert_eq!(cause["cause"], "several");
    let parts = cause["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 2, "{cause}");
    // The study's other changes, 0.42 mm and 0.29 mm of two offsets, are rounding: the table has d in whole centimetres
    // or millimetres there.
    // 107 mm before 11 mm.
    assert_eq!((&parts[0]["cause"], &parts[1]["cause"]), (&"parameter".into(), &"base".into()));
    assert_eq!((&parts[0]["joint"], &parts[0]["parameter"]), (&"left_w2".into(), &"d".into()));
}

#[test]
fn a_ur5_differs_from_a_ur5e_in_four_figures() {
    let pairing =
        Pairing { table: "ur5_rtb", urdf: "ur5e", base: "base", tip: "tool0", joints: &UR5E_JOINTS };
    let Some(cause) = published(&pairing) else { return };
    assert_eq!(cause["cause"], "several");
    // The four offsets d, each with the value that the URDF is typed with; a3 = -0.39225 rounds to its -0.3922.
    let parts = cause["parts"].as_array().unwrap();
    let expected: Vec<&Value> = parts.iter().map(|part| &part["expected"]).collect();
    assert_eq!(expected, [0.1625, 0.1333, 0.0996, 0.0997]);
    assert!(cause["residual_m"].as_f64().unwrap() < 0.51e-4, "{cause}");
}

/// With the other convention, the sign of the last joint alone changes nothing: one value, and not the same one twice.
#[test]
fn a_correction_that_changes_nothing_by_itself_has_no_value_after_it() {
    let folder = tempfile::tempdir().unwrap();
    let robot = fs::read_to_string(workspace().join("robots/ur5e/robot.toml")).unwrap();
    let urdf = text(&workspace().join("robots/ur5e/ur5e.urdf"));
    let (before, last) = robot.split_at(robot.rfind("sign = 1").unwrap());
    let wrong =
        before.replace("\"ur5e.urdf\"", &format!("\"{urdf}\"")).replace("\"standard\"", "\"modified\"")
            + &last.replacen("sign = 1", "sign = -1", 1);
    let path = folder.path().join("robot.toml");
    fs::write(&path, wrong).unwrap();
    let printed = congruent(&["check", &text(&path), "--tolerance", "1mm,0.1deg"]).stdout;
    let stages: Vec<&str> = printed.lines().filter(|line| line.contains("difference before: ")).collect();
    let [first, second] = stages[..] else { panic!("{printed}") };
    assert!(first.ends_with("1912 mm and 180 deg, not changed by it"), "{first}");
    assert!(second.ends_with(", after: <1 pm"), "{second}");
}
