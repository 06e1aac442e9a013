//! Limits that a scenario does not give, and tolerances that would let everything pass.

use std::fs;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

const AGREEMENT: &str = "[[check]]\nkind = \"agreement\"\n";
/// Servos without stiffness and damping.
const SLACK: &str = "[controller]\nkind = \"pd\"\nstiffness = 0.0\ndamping = 0.0\n";
const STIFF: &str = "[controller]\nkind = \"gravity_compensation\"\nstiffness = 2000.0\ndamping = 120.0\n";
const TURN: &str = "[[motion]]\nmove_joints_deg = { shoulder_pan_joint = 20.0 }\nduration_s = 1.0\n";
/// Half a turn in 5 ms.
const JUMP: &str = "[limits]\nover_limit = \"warn\"\n[[motion]]\nmove_joints_deg = { shoulder_pan_joint = 180.0 }\n\
                    duration_s = 0.005\n";

/// A scenario of the UR5e, its elbow up, with these parts.
fn scenario(scratch: &ScratchFolder, parts: &[&str]) -> String {
    let robot = text(&workspace().join("robots/ur5e"));
    let start = "joints_deg = { shoulder_lift_joint = -90.0, elbow_joint = 90.0 }";
    let text =
        format!("schema_version = 1\nname = \"s\"\nrobot = {robot:?}\n[start]\n{start}\n{}", parts.concat());
    scratch.write("s.toml", &text)
}

fn run(scratch: &ScratchFolder, parts: &[&str]) -> Answer {
    let out = text(&scratch.path().join("out"));
    congruent_json(&["run", &scenario(scratch, parts), "--no-recording", "--out", &out])
}

/// The check of this kind: whether it is a default one, and its status.
fn check(answer: &Answer, kind: &str) -> Option<(bool, String)> {
    let report = answer.json();
    let found = report["checks"].as_array().unwrap().iter().find(|check| check["check"] == kind)?.clone();
    Some((found["default"] == true, found["status"].as_str().unwrap().to_owned()))
}

#[test]
fn motions_are_tracked_without_being_asked() {
    let scratch = ScratchFolder::new();
    let status = |parts: &[&str], kind| {
        let answer = run(&scratch, parts);
        (answer.code, check(&answer, kind))
    };
    let passes = || Some((true, "pass".to_owned()));
    let fails = || Some((true, "fail".to_owned()));
    assert_eq!(status(&[STIFF, TURN, AGREEMENT], "tracking"), (0, passes()));
    assert_eq!(status(&[STIFF, TURN, AGREEMENT], "limits"), (0, passes()));
    assert_eq!(status(&[SLACK, TURN, AGREEMENT], "tracking"), (1, fails()), "it falls");
    assert_eq!(status(&["[controller]\nkind = \"passive\"\n", TURN, AGREEMENT], "tracking"), (1, fails()));
    assert_eq!(status(&[STIFF, JUMP, AGREEMENT], "tracking"), (1, fails()));
    let played = ["[controller]\nkind = \"kinematic\"\n", JUMP, AGREEMENT];
    assert_eq!(status(&played, "tracking"), (1, passes()), "a robot that is placed follows");
    assert_eq!(status(&played, "limits"), (1, fails()), "but no joint is as fast");
}

/// Servos without stiffness under compensated gravity: nothing moves, and the error is that of a small motion.
#[test]
fn a_small_motion_that_nobody_follows_fails() {
    let scratch = ScratchFolder::new();
    let idle = "[controller]\nkind = \"gravity_compensation\"\nstiffness = 0\ndamping = 0\n";
    for by_deg in [0.5, 4.0, 5.0] {
        let turn = format!(
            "[[motion]]\nmove_joints_deg = {{ shoulder_pan_joint = {by_deg:?} }}\nduration_s = 0.4\n"
        );
        let answer = run(&scratch, &[idle, &turn, AGREEMENT]);
        assert_eq!(
            (answer.code, check(&answer, "tracking")),
            (1, Some((true, "fail".to_owned()))),
            "{by_deg}"
        );
        let followed = run(&scratch, &[STIFF, &turn, AGREEMENT]);
        assert_eq!(followed.code, 0, "{by_deg}: {}", followed.stdout);
    }
}

/// Feedback hides it from every other check, and the diagnosis names it.
#[test]
fn a_scaled_torque_is_seen_without_being_asked() {
    let scratch = ScratchFolder::new();
    let controller = "[controller]\nkind = \"computed_torque\"\nstiffness = 400.0\ndamping = 40.0\n";
    // The wrist is so light that the motion alone does not show it.
    for (joint, share) in [("elbow_joint", 0.8), ("elbow_joint", 1.3), ("wrist_2_joint", 0.8)] {
        let fault = format!(
            "[[fault]]\nkind = \"scaled_torque\"\njoint = \"{joint}\"\nshare = {share}\nat_s = 0.3\n"
        );
        let answer = run(&scratch, &[controller, TURN, AGREEMENT, &fault]);
        assert_eq!((answer.code, check(&answer, "effort")), (1, Some((true, "fail".to_owned()))), "{share}");
        let report = answer.json();
        let found = &report["diagnosis"]["faults"][0];
        assert_eq!(
            (&found["kind"], &found["joints"][0]),
            (&"scaled_torque".into(), &joint.into()),
            "{report}"
        );
    }
}

#[test]
fn a_check_of_the_scenario_takes_the_place_of_a_default_one() {
    let scratch = ScratchFolder::new();
    let wide = "[[check]]\nkind = \"tracking\"\npath_deg = 170.0\n";
    let answer = run(&scratch, &[STIFF, TURN, AGREEMENT, wide]);
    assert_eq!((answer.code, check(&answer, "tracking")), (0, Some((false, "pass".to_owned()))));
    assert!(
        answer.stderr.is_empty() || answer.stderr.contains("is more than a tenth of half a turn"),
        "{}",
        answer.stderr
    );
    let kinds = |answer: &Answer| answer.json()["checks"].as_array().unwrap().len();
    assert_eq!(kinds(&answer), 4, "agreement, tracking, and limits and effort by default");
    // What was checked by default is written, and checked again.
    let resolved = fs::read_to_string(scratch.path().join("out/s/scenario.resolved.toml")).unwrap();
    assert_eq!(resolved.matches("[[check]]").count(), 4, "{resolved}");
    let again = scratch.write("again.toml", &resolved);
    let out = text(&scratch.path().join("again"));
    let again = congruent_json(&["run", &again, "--no-recording", "--out", &out]);
    assert_eq!((again.code, kinds(&again)), (0, 4), "{}", again.stderr);
    let junit = fs::read_to_string(scratch.path().join("out/s/junit.xml")).unwrap();
    assert!(junit.contains("name=\"3_limits_default\""), "{junit}");
}

#[test]
fn a_default_check_that_fails_beside_the_expected_ones_is_not_expected() {
    let scratch = ScratchFolder::new();
    let far = "[[check]]\nkind = \"goal\"\ntcp = { xyz_m = [0, 0, 9] }\nposition_m = 0.01\n";
    let expected = |checks: &str| format!("[expect]\nverdict = \"fail\"\nchecks = {checks}\n");
    let code = |parts: &[&str]| run(&scratch, parts).code;
    assert_eq!(code(&[STIFF, TURN, far, &expected("[\"goal\"]")]), 0);
    assert_eq!(code(&[STIFF, JUMP, far, &expected("[\"goal\"]")]), 1);
    assert_eq!(code(&[STIFF, TURN]), 4, "default checks alone are no success");
}

#[test]
fn a_tolerance_as_large_as_the_robot_is_refused() {
    let scratch = ScratchFolder::new();
    let refused = |check: &str, key: &str| {
        let answer = run(&scratch, &[STIFF, TURN, check]);
        assert_eq!(answer.code, 2, "{check}: {}", answer.stderr);
        let finding = &answer.json()["findings"][0];
        let message = finding["message"].as_str().unwrap();
        assert_eq!(finding["code"], "tolerance::meaningless", "{message}");
        assert!(message.contains(&format!("`{key}`")) && finding["line"].is_u64(), "{finding}");
        message.to_owned()
    };
    let message = refused("[[check]]\nkind = \"agreement\"\nposition_m = 1e9\n", "position_m");
    assert!(message.contains("reach of the robot, 1089 mm"), "{message}");
    refused("[[check]]\nkind = \"agreement\"\norientation_deg = 181\n", "orientation_deg");
    refused("[[check]]\nkind = \"tracking\"\npath_tcp_mm = 5e3\n", "path_tcp_mm");
    refused("[[check]]\nkind = \"cycle_time\"\nlimit_s = 3\ntolerance_rad = 4\n", "tolerance_rad");
    refused("[[check]]\nkind = \"limits\"\ntolerance_deg = 360\n", "tolerance_deg");
    refused("[[check]]\nkind = \"contact\"\ndepth_m = 2\n", "depth_m");
    refused("[[check]]\nkind = \"goal\"\nposition_m = 2\ntcp = { xyz_m = [0, 0, 1] }\n", "position_m");
    let message = refused("[[check]]\nkind = \"dynamics\"\nrelative = 30\n", "relative");
    assert!(message.contains("is above 1"), "{message}");
    refused("[[check]]\nkind = \"power\"\nrelative = 1.1\n", "relative");
    refused("[[check]]\nkind = \"invariants\"\nrotation = 1e3\n", "rotation");
    let message = refused("[[check]]\nkind = \"twist\"\nlinear_m_s = 1e6\n", "linear_m_s");
    assert!(message.contains("the largest possible speed"), "{message}");
    refused("[[check]]\nkind = \"twist\"\nangular_deg_s = 1e6\n", "angular_deg_s");
    let out = text(&scratch.path().join("out"));
    let wide = scenario(&scratch, &[STIFF, TURN, "[[check]]\nkind = \"agreement\"\nposition_m = 0.2\n"]);
    let answer = congruent(&["run", &wide, "--no-recording", "--out", &out]);
    assert!(answer.code == 0 && answer.stderr.contains("tolerance::wide"), "{}", answer.stderr);
}

#[test]
fn so_is_that_of_a_robot_file_and_of_the_command_line() {
    let scratch = ScratchFolder::new();
    let ur5e = workspace().join("robots/ur5e");
    let robot = fs::read_to_string(ur5e.join("robot.toml")).unwrap();
    let urdf = text(&ur5e.join("ur5e.urdf"));
    let robot = robot.replace("urdf = \"ur5e.urdf\"", &format!("urdf = {urdf:?}"));
    let (before, _) = robot.split_once("[tolerance]").unwrap_or((&robot, ""));
    let file = scratch.write("robot.toml", &format!("{before}\n[tolerance]\nposition_mm = 1e6\n"));
    let answer = congruent(&["check", &file]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    assert!(
        answer.stderr.contains("tolerance::meaningless") && answer.stderr.contains("position_mm"),
        "{}",
        answer.stderr
    );
    let of_call =
        |tolerance: &str| congruent(&["check", "robots/ur5e/tool_5mm_off.toml", "--tolerance", tolerance]);
    let answer = of_call("1e9m");
    assert!(answer.code == 2 && answer.stderr.contains("--tolerance"), "{}", answer.stderr);
    assert_eq!(of_call("200deg").code, 2);
    let answer = of_call("200mm,1deg");
    assert!(answer.code == 0 && answer.stderr.contains("tolerance::wide"), "{}", answer.stderr);
}
