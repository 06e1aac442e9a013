//! What is compared under a declared `[mapping]`: the zero of the last joint, too, and one fault has one cause.

use std::fs;

use crate::support::{
    command::{congruent, congruent_json},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

fn urdf() -> String {
    fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap()
}

/// Two copies of one URDF: 45 deg in the zero of the last joint show at the frame of the link that both call the tip.
#[test]
fn the_frame_of_the_tip_shows_a_wrong_zero_of_the_last_joint() {
    let scratch = ScratchFolder::new();
    let other = scratch.write("other.urdf", &urdf());
    scratch.write("ur5e.urdf", &urdf());
    for (offset_deg, code) in [(0, 0), (45, 1), (90, 1)] {
        let lines = format!("[mapping.joints]\nwrist_3_joint = {{ offset_deg = {offset_deg} }}\n");
        let robot = scratch.write("robot.toml", &format!("description = \"ur5e.urdf\"\n{lines}"));
        let answer = congruent(&["check", &robot, "--against", &other, "--tip", "wrist_3_link", "-q"]);
        assert_eq!(answer.code, code, "{offset_deg}: {}", answer.stdout);
        assert_eq!(answer.stdout.contains("wrist_3"), code == 1, "{}", answer.stdout);
    }
}

/// With other names alone, declared or found, a wrong origin is the same one cause.
#[test]
fn declared_names_change_no_cause() {
    let scratch = ScratchFolder::new();
    let own = scratch.write("ur5e.urdf", &urdf());
    let renamed = urdf().replace("_joint\"", "_axis\"");
    let wrong = renamed.replacen("<origin xyz=\"0 0 0.1625\"/>", "<origin xyz=\"0 0.03 0.1725\"/>", 1);
    assert_ne!(renamed, wrong);
    let other = scratch.write("other.urdf", &wrong);
    let names = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
    let lines = names.map(|name| format!("{name}_joint = \"{name}_axis\"\n")).concat();
    let declared = format!("description = \"ur5e.urdf\"\n[mapping.joints]\n{lines}");
    let declared = scratch.write("robot.toml", &declared);
    for file in [&own, &declared] {
        let report = congruent_json(&["check", file, "--against", &other]).json();
        assert_eq!(report["diagnosis"][0]["joint"], "shoulder_pan_joint", "{file}: {report:#}");
        assert_eq!(report["diagnosis"][0]["cause"], "joint_origin", "{file}");
    }
}

/// A tip that the other file calls otherwise and places 100 mm away is compared, whatever the digits of the joints allow; and so is
/// the last link, placed 100 mm away along the axis of its joint, which moves no axis.
#[test]
fn a_tip_in_another_place_is_a_difference_behind_a_mapping() {
    let urdf = fs::read_to_string(workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let tip = urdf.find("<joint name=\"tip_joint\"").unwrap();
    let tip = &urdf[tip..tip + urdf[tip..].find("</joint>").unwrap() + "</joint>".len()];
    let without_tip = urdf.replace(tip, "").replace("<link name=\"tip\"/>", "");
    let elsewhere = "<origin xyz=\"0.4 0 0.1\"/>";
    let other_tip = urdf
        .replace(tip, &tip.replace("\"tip\"", "\"tool\"").replace("<origin xyz=\"0.4 0 0\"/>", elsewhere))
        .replace("<link name=\"tip\"/>", "<link name=\"tool\"/>");
    let other_link = without_tip
        .replace("<origin xyz=\"0.6 0 0\"/>\n    <parent", "<origin xyz=\"0.6 0 0.1\"/>\n    <parent");
    for (own, other) in [(&urdf, other_tip), (&without_tip, other_link)] {
        assert_ne!(*own, other);
        let scratch = ScratchFolder::new();
        scratch.write("own.urdf", own);
        let robot = scratch.write(
            "robot.toml",
            "description = \"own.urdf\"\n[mapping.joints]\njoint_1 = { joint = \"A1\" }\n",
        );
        let other = scratch.write("other.urdf", &other.replace("\"joint_1\"", "\"A1\""));
        let answer = congruent(&["check", &robot, "--against", &other, "-q"]);
        assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
        assert!(answer.stdout.contains("DIFFERENT, by up to 100 mm"), "{}", answer.stdout);
        assert!(answer.stdout.contains("off by 100 mm"), "{}", answer.stdout);
    }
}

/// All axes of a planar arm are parallel: how high its base is, no axis shows, and the tip does.
#[test]
fn a_fitted_base_of_a_planar_arm_has_the_height_of_its_tip() {
    let urdf = fs::read_to_string(workspace().join("robots/planar_2r/planar_2r.urdf")).unwrap();
    let first = "<joint name=\"joint_1\" type=\"revolute\">\n    <origin xyz=\"0 0 0\"/>";
    assert!(urdf.contains(first));
    let higher = urdf.replace(first, &first.replace("0 0 0", "0.1 0 0.2"));
    let scratch = ScratchFolder::new();
    scratch.write("own.urdf", &urdf);
    let robot = scratch
        .write("robot.toml", "description = \"own.urdf\"\ntip = \"tip\"\n[mapping]\nbase = \"fitted\"\n");
    let other = scratch.write("other.urdf", &higher);
    let answer = congruent(&["check", &robot, "--against", &other]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("its root frame is at x -100 mm"), "{}", answer.stdout);
    assert!(answer.stdout.contains("z -200 mm"), "{}", answer.stdout);
}

/// A finger that the other file fixes is held at 0, and what it carries is compared; one that is left out moves nowhere else.
#[test]
fn a_finger_that_one_file_fixes_is_compared_at_zero() {
    let urdf = fs::read_to_string(workspace().join("robots/rrr_arm/rrr_arm.urdf")).unwrap();
    let scratch = ScratchFolder::new();
    scratch.write("arm.urdf", &urdf);
    let fixed = urdf
        .replace("name=\"gripper_joint_2\" type=\"prismatic\"", "name=\"gripper_joint_2\" type=\"fixed\"");
    assert_ne!(fixed, urdf);
    let other = scratch.write("other.urdf", &fixed);
    let check = |left_out: &str| {
        let lines = format!("description = \"arm.urdf\"\n[mapping]\nleft_out = [\"{left_out}\"]\n");
        congruent(&["check", &scratch.write("robot.toml", &lines), "--against", &other])
    };
    let declared = check("gripper_joint_2");
    assert!(declared.stdout.contains("with gripper_joint_2 at 0)"), "{}", declared.stdout);
    assert!(declared.stdout.contains("compared with them at 0: gripper_joint_2\n"), "{}", declared.stdout);
    let undeclared = check("gripper_joint_1");
    assert!(
        undeclared.stdout.contains("JOINTS: gripper_joint_2 moves in arm.urdf alone;"),
        "{}",
        undeclared.stdout
    );
    assert!(!undeclared.stdout.contains("elsewhere on the robot"), "{}", undeclared.stdout);
}
