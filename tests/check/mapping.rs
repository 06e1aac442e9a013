//! `congruent check --against` of descriptions whose joints have other names, directions and zeros: what is found is what was
//! written, and what is declared counts as the same.

use std::fs;

use ::congruent::nalgebra::{Isometry3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use regex_lite::Regex;
use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json},
    corpus::{corpus, workspace},
    scratch_folder::ScratchFolder,
};

/// A joint of a URDF in another variable: `q_there = sign * q_here + zero`.
struct Change {
    joint: &'static str,
    there: &'static str,
    sign: f64,
    zero: f64,
}

/// Rounding of a rotation matrix to angles and back.
const ROUNDING: f64 = 1e-9;

fn change(joint: &'static str, there: &'static str, sign: f64, zero: f64) -> Change {
    Change { joint, there, sign, zero }
}

/// Every joint of a UR5e in other variables, as another vendor might count them.
fn ur5e() -> Vec<Change> {
    vec![
        change("shoulder_pan_joint", "J1", -1.0, 0.7),
        change("shoulder_lift_joint", "J2", 1.0, std::f64::consts::FRAC_PI_2),
        change("elbow_joint", "J3", -1.0, 0.0),
        change("wrist_1_joint", "J4", -1.0, -1.1),
        change("wrist_2_joint", "J5", 1.0, 0.0),
        change("wrist_3_joint", "J6", -1.0, 0.25),
    ]
}

/// The URDF with its joints in other variables: with `q = sign (q_there - zero)` the turn about `a` is a constant one, which
/// goes to the origin, and one about `sign a`.
fn in_variables(urdf: &str, changes: &[Change]) -> String {
    let mut text = urdf.to_owned();
    for Change { joint, there, sign, zero } in changes {
        let start = text.find(&format!("<joint name=\"{joint}\"")).unwrap_or_else(|| panic!("no {joint}"));
        let end = start + text[start..].find("</joint>").unwrap();
        let block = &text[start..end];
        let numbers = |attribute: &str| -> Option<Vec<f64>> {
            let found = Regex::new(&format!(r#"\b{attribute}="([^"]*)""#)).unwrap();
            let list = found.captures(block)?.get(1)?.as_str().to_owned();
            Some(list.split_whitespace().map(|number| number.parse().unwrap()).collect())
        };
        let origin = Regex::new(r"<origin[^>]*/>").unwrap();
        let tag = origin.find(block).map_or("", |found| found.as_str());
        let of_origin = |attribute: &str| tag.contains(attribute).then(|| numbers(attribute)).flatten();
        let xyz = of_origin("xyz").unwrap_or_else(|| vec![0.0; 3]);
        let rpy = of_origin("rpy").unwrap_or_else(|| vec![0.0; 3]);
        let axis = Regex::new(r#"<axis xyz="([^"]*)"/>"#).unwrap();
        let written: Vec<f64> = axis.captures(block).unwrap()[1]
            .split_whitespace()
            .map(|number| number.parse().unwrap())
            .collect();
        let direction = Unit::new_normalize(Vector3::from_vec(written));
        let before = Isometry3::from_parts(
            Translation3::new(xyz[0], xyz[1], xyz[2]),
            UnitQuaternion::from_euler_angles(rpy[0], rpy[1], rpy[2]),
        );
        let after = before * UnitQuaternion::from_axis_angle(&direction, -sign * zero);
        let (roll, pitch, yaw) = Rotation3::from(after.rotation).euler_angles();
        let moved = direction.into_inner() * *sign;
        let range = numbers("lower").zip(numbers("upper"));
        let mut new = origin
            .replace(
                block,
                format!(
                    "<origin xyz=\"{} {} {}\" rpy=\"{roll:?} {pitch:?} {yaw:?}\"/>",
                    xyz[0], xyz[1], xyz[2]
                ),
            )
            .into_owned();
        new = axis
            .replace(&new, format!("<axis xyz=\"{:?} {:?} {:?}\"/>", moved.x, moved.y, moved.z))
            .into_owned();
        if let Some((lower, upper)) = range {
            let ends = [lower[0], upper[0]].map(|end| sign * end + zero);
            let (lower, upper) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            new = Regex::new(r#"lower="[^"]*" upper="[^"]*""#)
                .unwrap()
                .replace(&new, format!("lower=\"{lower:?}\" upper=\"{upper:?}\""))
                .into_owned();
        }
        let new = new.replace(&format!("name=\"{joint}\""), &format!("name=\"{there}\""));
        text.replace_range(start..end, &new);
    }
    text
}

/// A robot file in a folder of its own, with its URDF and the other one.
struct Robots {
    scratch: ScratchFolder,
    robot_file: String,
    other: String,
}

impl Robots {
    fn new(other: &str) -> Self {
        let scratch = ScratchFolder::new();
        scratch.write("ur5e.urdf", &urdf());
        let other = scratch.write("other.urdf", other);
        let robot_file = scratch.write("robot.toml", "urdf = \"ur5e.urdf\"\ntip = \"tool0\"\n");
        Self { scratch, robot_file, other }
    }

    fn check(&self) -> Answer {
        congruent_json(&["check", &self.robot_file, "--against", &self.other])
    }

    /// The robot file with these lines added.
    fn declare(&self, lines: &[&str]) {
        let before = fs::read_to_string(&self.robot_file).unwrap();
        self.scratch.write("robot.toml", &format!("{before}\n{}\n", lines.join("\n")));
    }
}

fn urdf() -> String {
    fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap()
}

/// The lines that the report would declare.
fn lines(report: &Value) -> Vec<String> {
    let lines = report["against"]["mapping"]["lines"].as_array().unwrap().iter();
    lines.map(|line| line.as_str().unwrap().to_owned()).collect()
}

#[test]
fn other_names_directions_and_zeros_are_found_as_they_were_written() {
    let changes = ur5e();
    let robots = Robots::new(&in_variables(&urdf(), &changes));
    let answer = robots.check();
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!([&report["verdict"], &report["grade"]], ["disagree", "equal_after_mapping"]);
    let mapping = &report["against"]["mapping"];
    assert_eq!(mapping["matched_by"], "order");
    for (found, change) in mapping["joints"].as_array().unwrap().iter().zip(&changes) {
        assert_eq!([&found["joint"], &found["other"]], [change.joint, change.there]);
        assert_eq!(found["sign"].as_f64(), Some(change.sign), "{found}");
        assert!((found["offset"].as_f64().unwrap() - change.zero).abs() < ROUNDING, "{found}");
    }
    // In the same variables everything is compared, and agrees.
    assert_eq!(report["against"]["dynamics_not_compared"], Value::Null);
    assert_eq!(report["dynamics"]["verdict"], "same", "{:#}", report["dynamics"]);
}

#[test]
fn what_the_report_would_declare_makes_the_two_the_same() {
    let robots = Robots::new(&in_variables(&urdf(), &ur5e()));
    let lines = lines(&robots.check().json());
    robots.declare(&lines.iter().map(String::as_str).collect::<Vec<_>>());
    let answer = robots.check();
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    // A wrong direction is not.
    let wrong: Vec<String> =
        lines.iter().map(|line| line.replace("sign = -1, offset_rad = 0.7", "offset_rad = 0.7")).collect();
    assert_ne!(wrong, lines);
    let robots = Robots::new(&in_variables(&urdf(), &ur5e()));
    robots.declare(&wrong.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(robots.check().code, 1);
}

#[test]
fn a_fault_in_other_variables_is_named_at_the_joint_and_link_of_the_robot() {
    let other = in_variables(&urdf(), &ur5e());
    let heavier = other.replacen("<mass value=\"8.058\"/>", "<mass value=\"9.058\"/>", 1);
    assert_ne!(other, heavier);
    let robots = Robots::new(&heavier);
    robots.declare(&lines(&robots.check().json()).iter().map(String::as_str).collect::<Vec<_>>());
    let report = robots.check().json();
    assert_eq!(report["dynamics"]["verdict"], "explained");
    let first = &report["dynamics"]["explanations"][0]["figures"][0];
    assert_eq!([&first["of"], &first["figure"]], ["upper_arm_link", "mass"], "{first:#}");
}

#[test]
fn an_origin_behind_other_names_is_off_by_what_was_changed() {
    let names: Vec<Change> = ur5e().into_iter().map(|of| Change { sign: 1.0, zero: 0.0, ..of }).collect();
    let other = in_variables(&urdf(), &names);
    let moved = other.replacen("-0.3922 0 0.1333\"", "-0.3922 0 0.1373\"", 1);
    assert_ne!(other, moved);
    let robots = Robots::new(&moved);
    let report = robots.check().json();
    let worst = report["against"]["mapping"]["position_m"].as_f64().unwrap();
    assert!((worst - 0.004).abs() < 1e-9, "{worst}");
    let fault = &report["diagnosis"][0];
    assert_eq!(
        (fault["cause"].as_str(), fault["joint"].as_str()),
        (Some("joint_origin"), Some("wrist_1_joint"))
    );
}

#[test]
fn an_origin_behind_other_zeros_changes_no_zero() {
    let other = in_variables(&urdf(), &ur5e());
    let moved = other.replacen("-0.3922 0 0.1333\"", "-0.3822 0 0.1333\"", 1);
    assert_ne!(other, moved);
    let report = Robots::new(&moved).check().json();
    let mapping = &report["against"]["mapping"];
    assert!((mapping["position_m"].as_f64().unwrap() - 0.01).abs() < 1e-8, "{mapping:#}");
    for (found, change) in mapping["joints"].as_array().unwrap().iter().zip(ur5e()) {
        assert!((found["offset"].as_f64().unwrap() - change.zero).abs() < 1e-8, "{found}");
    }
    assert_eq!(report["diagnosis"].as_array().map(Vec::len), Some(1), "{:#}", report["diagnosis"]);
    assert_eq!(report["diagnosis"][0]["joint"], "wrist_1_joint");
}

#[test]
fn exchanged_names_of_joints_are_found_by_the_links_that_they_carry() {
    let text = urdf();
    let other = ["elbow_joint", "wrist_1_joint"].map(|name| format!("<joint name=\"{name}\""));
    let exchanged = text.replace(&other[0], "<joint name=\"\"").replace(&other[1], &other[0]);
    let exchanged = exchanged.replace("<joint name=\"\"", &other[1]);
    let robots = Robots::new(&exchanged);
    let report = robots.check().json();
    assert_eq!(report["grade"], "equal_after_mapping");
    assert_eq!(report["against"]["mapping"]["matched_by"], "links");
    assert_eq!(report["dynamics"]["verdict"], "same", "{:#}", report["dynamics"]);
    robots.declare(&lines(&report).iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(robots.check().code, 0);
}

#[test]
fn a_robot_file_holds_its_references_together() {
    let other = in_variables(&urdf(), &ur5e());
    let robots = Robots::new(&other);
    let mapping = lines(&robots.check().json());
    let mapping: Vec<String> =
        mapping.iter().map(|line| line.replace("[mapping", "[reference.mapping")).collect();
    let mut declared =
        vec!["[[reference]]", "file = \"copy.urdf\"", "[[reference]]", "file = \"other.urdf\""];
    declared.extend(mapping.iter().map(String::as_str));
    robots.declare(&declared);
    robots.scratch.write("copy.urdf", &urdf());
    let answer = congruent(&["check", "-q", &robots.robot_file]);
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert_eq!(answer.stdout.matches("SAME ROBOT").count(), 2);
    for name in ["copy.urdf", "other.urdf"] {
        assert!(answer.stdout.contains(&format!("{name}: SAME ROBOT")), "{}", answer.stdout);
    }
    // One of them changes.
    let wrong = other.replacen("lower=", "lower=\"-0.5\" was=", 1);
    robots.scratch.write("other.urdf", &wrong);
    let answer = congruent(&["check", "-q", &robots.robot_file]);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
}

#[test]
fn other_robots_are_not_mapped() {
    let panda = fs::read_to_string(workspace().join("robots/panda/panda.urdf")).unwrap();
    let robots = Robots::new(&panda);
    let answer = congruent(&["check", "-q", &robots.robot_file, "--against", &robots.other]);
    let printed = &answer.stdout;
    assert!(printed.contains("DIFFERENT JOINTS"), "{printed}");
    assert_eq!(answer.code, 1);
}

#[test]
fn faults_of_a_mapping_say_what_is_known() {
    for (line, message) in [
        ("elbow_join = \"J3\"", "elbow_joint"),
        ("elbow_joint = { joint = \"J3\", sign = 2 }", "sign of \"elbow_joint\" must be 1 or -1"),
        ("elbow_joint = { joint = \"J3\", offset_m = 0.1 }", "joint \"elbow_joint\" turns"),
        (
            "elbow_joint = { joint = \"J3\", offset_rad = 1, offset_deg = 3 }",
            "by offset_rad and by offset_deg",
        ),
        ("elbow_joint = 3", "the name of the joint there"),
    ] {
        let robots = Robots::new(&urdf());
        robots.declare(&["[mapping.joints]", line]);
        let answer = congruent(&["check", &robots.robot_file, "--against", &robots.other]);
        let printed = answer.stdout.clone() + &answer.stderr;
        assert_eq!(answer.code, 2, "{line}: {printed}");
        assert!(
            printed.split_whitespace().collect::<Vec<_>>().join(" ").replace(" │ ", " ").contains(message),
            "{line}: {printed}"
        );
    }
}

#[test]
fn a_mapping_that_does_not_fit_the_other_file_is_bad_input() {
    for (lines, message) in [
        (&["[mapping.joints]", "elbow_joint = \"J33\""][..], "has no moving joint \"J33\""),
        (&["[mapping.joints]", "elbow_joint = \"J4\"", "wrist_1_joint = \"J4\""], "two joints are \"J4\""),
        (
            &["[mapping]", "left_out = [\"finger\"]"],
            "left_out names \"finger\", a joint that neither description has",
        ),
    ] {
        let robots = Robots::new(&in_variables(&urdf(), &ur5e()));
        robots.declare(lines);
        let answer = congruent(&["check", &robots.robot_file, "--against", &robots.other]);
        assert_eq!((answer.code, answer.stdout.as_str()), (2, ""), "{lines:?}: {}", answer.stdout);
        let printed = answer.stderr.split_whitespace().collect::<Vec<_>>().join(" ").replace(" │ ", " ");
        assert!(printed.contains(message) && printed.contains("check::declared_mapping"), "{printed}");
    }
}

/// Two public URDFs of one arm, whose joints 2 and 3 have their zeros half a turn apart, as an independent program found.
#[test]
fn two_descriptions_of_a_jaco_differ_by_two_zeros() {
    let Some(corpus) = corpus() else { return };
    let pair = corpus.join("pairs/urdf-jaco-kinova-drake");
    let [a, b] = ["a.urdf", "b.urdf"].map(|name| pair.join(name).display().to_string());
    let report = congruent_json(&["check", &a, "--against", &b]).json();
    let expected: Value = serde_json::from_str(&fs::read_to_string(pair.join("pair.json")).unwrap()).unwrap();
    let found = report["against"]["mapping"]["joints"].as_array().unwrap();
    for joint in expected["joints"].as_array().unwrap() {
        let here = found.iter().find(|of| of["joint"] == joint["a"]).unwrap();
        assert_eq!([&here["other"], &here["sign"]], [&joint["b"], &joint["sign"]]);
        let off = here["offset"].as_f64().unwrap() - joint["offset_rad"].as_f64().unwrap();
        // The independent fit is of random poses, to some picometres.
        assert!(off.abs() < 1e-9, "{here} {joint}");
    }
}

#[test]
fn a_wrong_table_of_the_other_description_is_not_the_same_robot() {
    let scratch = ScratchFolder::new();
    let robot = fs::read_to_string(workspace().join("robots/ur5e/robot.toml")).unwrap();
    scratch.write("ur5e.urdf", &urdf());
    let own = scratch.write("own.toml", &robot);
    let wrong = robot.replacen("d_m = 0.1625", "d_m = 0.1825", 1);
    assert_ne!(robot, wrong);
    let other = scratch.write("other.toml", &wrong);
    let report = congruent_json(&["check", &own, "--against", &other]).json();
    assert_eq!(report["verdict"], "disagree");
    let named = report["comparisons"].as_array().unwrap().iter().map(|of| of["name"].as_str().unwrap());
    assert!(named.into_iter().any(|name| name == "other_model_urdf"));
    assert!(report["diagnosis"][0]["file"].as_str().unwrap().ends_with("other.toml"), "{report:#}");
    let same = congruent(&["check", "-q", &own, "--against", &own]);
    assert_eq!(same.code, 0, "{}", same.stdout);
}

#[test]
fn fingers_that_another_finger_drives_have_the_same_coupling() {
    let gripper = |left: &str, right: &str| {
        let finger = |name: &str, y: &str, mimic: &str| {
            format!(
                "<link name=\"{name}\"/><joint name=\"{name}_joint\" type=\"prismatic\"><parent link=\"palm\"/>\
                 <child link=\"{name}\"/><origin xyz=\"0.1 0 0\"/><axis xyz=\"0 {y} 0\"/>\
                 <limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>{mimic}</joint>"
            )
        };
        let fingers = finger("left", "1", left) + &finger("right", "-1", right);
        format!("<robot name=\"gripper\"><link name=\"palm\"/>{fingers}</robot>")
    };
    let scratch = ScratchFolder::new();
    let own = scratch.write("own.urdf", &gripper("", "<mimic joint=\"left_joint\"/>"));
    let other = scratch.write("other.urdf", &gripper("<mimic joint=\"right_joint\"/>", ""));
    let answer = congruent_json(&["check", &own, "--against", &other]);
    let report = answer.json();
    assert_eq!(report["comparisons"][1]["verdict"], "agree", "{report:#}");
    let messages = report["warnings"].as_array().unwrap().iter().map(|of| of["message"].as_str().unwrap());
    assert!(messages.into_iter().any(|of| of.contains("right_joint drives")), "{report:#}");
    let wrong =
        scratch.write("wrong.urdf", &gripper("<mimic joint=\"right_joint\" multiplier=\"0.5\"/>", ""));
    assert_eq!(congruent(&["check", "-q", &own, "--against", &wrong]).code, 1);
}
