//! What a stranger does wrong in a URDF: units in several links, a link that only one file has, values that no body
//! has or that are no number, and what a robot file omits. On the UR5e; the right link and line are named, and
//! what is suggested makes the check agree.

use std::{fs, path::PathBuf};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    suggested_changes::{apply, names},
};

const FOREARM_MASS: &str = "<mass value=\"2.846\"/>";
const FOREARM_INERTIA: &str = "<inertia ixx=\"0.03120936758333333\" ixy=\"0\" ixz=\"0\" iyy=\"0.03120936758333333\" iyz=\"0\" izz=\"0.004095\"/>";

fn original() -> PathBuf {
    workspace().join("robots/ur5e/ur5e.urdf")
}

/// A UR5e with other texts, each of which is in the file.
struct Wrong {
    folder: tempfile::TempDir,
}

impl Wrong {
    #[track_caller]
    fn new(changes: &[(&str, &str)]) -> Self {
        let mut urdf = fs::read_to_string(original()).unwrap();
        for (old, new) in changes {
            assert!(urdf.contains(old), "{old}");
            urdf = urdf.replacen(old, new, 1);
        }
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("ur5e.urdf"), urdf).unwrap();
        Self { folder }
    }

    fn urdf(&self) -> PathBuf {
        self.folder.path().join("ur5e.urdf")
    }

    fn against_original(&self) -> Answer {
        congruent_json(&["check", &text(&self.urdf()), "--against", &text(&original())])
    }

    /// Causes with their details and places, and that what is suggested makes the two agree.
    #[track_caller]
    fn named(&self, expected: &[(&str, &str, &[&str])]) -> Value {
        let answer = self.against_original();
        assert_eq!(answer.code, 1, "{}", answer.stdout);
        let report = answer.json();
        let explanations = &report["dynamics"]["explanations"];
        let explained: Vec<&Value> = explanations.as_array().unwrap().iter().collect();
        let parts = |of: &&Value| of["parts"].as_array().unwrap().clone();
        let all: Vec<Value> = explained
            .iter()
            .flat_map(|of| if parts(of).is_empty() { vec![(*of).clone()] } else { parts(of) })
            .collect();
        let found: Vec<(&str, &str, Vec<&str>)> = all
            .iter()
            .map(|of| (of["cause"].as_str().unwrap(), of["detail"].as_str().unwrap(), names(&of["place"])))
            .collect();
        let expected: Vec<_> = expected.iter().map(|of| (of.0, of.1, of.2.to_vec())).collect();
        assert_eq!(found, expected, "{explanations:#}");
        apply(explanations);
        let answer = self.against_original();
        assert_eq!(answer.code, 0, "{}", answer.stdout);
        report
    }
}

#[test]
fn two_links_in_wrong_units() {
    let wrong = Wrong::new(&[
        (FOREARM_MASS, "<mass value=\"2846\"/>"),
        ("<mass value=\"1.37\"/>", "<mass value=\"1370\"/>"),
    ]);
    let answer = congruent(&["check", &text(&wrong.urdf()), "--against", &text(&original())]);
    let sentence = "forearm_link: the mass is given in another unit (g); wrist_1_link: the mass is given in another unit (g)";
    assert!(answer.stdout.contains(sentence), "{}", answer.stdout);
    wrong.named(&[("mass_unit", "g", &["forearm_link"]), ("mass_unit", "g", &["wrist_1_link"])]);
}

#[test]
fn one_factor_of_all_links() {
    let urdf = fs::read_to_string(original()).unwrap();
    let inertias: Vec<&str> =
        urdf.split("<inertia ").skip(1).map(|rest| &rest[..rest.find("/>").unwrap()]).collect();
    let scaled: Vec<(String, String)> = inertias
        .iter()
        .map(|inertia| {
            let values = inertia.split('"').enumerate().map(|(at, part)| match part.parse::<f64>() {
                Ok(value) if at % 2 == 1 => (value * 1.1).to_string(),
                _ => part.to_owned(),
            });
            let new = values.collect::<Vec<String>>().join("\"");
            (format!("<inertia {inertia}/>"), format!("<inertia {new} />"))
        })
        .collect();
    let changes: Vec<(&str, &str)> = scaled.iter().map(|(old, new)| (old.as_str(), new.as_str())).collect();
    Wrong::new(&changes).named(&[("inertia_scale", "", &["*"])]);
}

#[test]
fn rounded_conversions_are_recognised() {
    let wrong = Wrong::new(&[(FOREARM_MASS, "<mass value=\"6.27\"/>")]);
    wrong.named(&[("mass_unit", "lb", &["forearm_link"])]);
    // 0.03120936758 kg m^2 and 0.004095 kg m^2 in lb ft^2.
    let rounded = "<inertia ixx=\"0.741\" ixy=\"0\" ixz=\"0\" iyy=\"0.741\" iyz=\"0\" izz=\"0.0972\"/>";
    let wrong = Wrong::new(&[(FOREARM_INERTIA, rounded)]);
    wrong.named(&[("inertia_unit", "lb_ft2", &["forearm_link"])]);
}

const CAMERA: &str = "<link name=\"camera\"><inertial><origin xyz=\"0 0.02 0.05\"/><mass value=\"0.5\"/>\
    <inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" iyy=\"0.001\" iyz=\"0\" izz=\"0.001\"/></inertial></link>\
    <joint name=\"holder\" type=\"fixed\"><parent link=\"tool0\"/><child link=\"camera\"/></joint></robot>";

#[test]
fn a_link_that_only_one_file_has() {
    let wrong = Wrong::new(&[("</robot>", CAMERA)]);
    let report = congruent_json(&["check", &text(&original()), "--against", &text(&wrong.urdf())]).json();
    let first = &report["dynamics"]["explanations"][0];
    assert_eq!((first["cause"].as_str(), names(&first["place"])), (Some("link_missing"), vec!["camera"]));
    assert!(first["suggestion"].as_str().unwrap().starts_with("add link camera"), "{first:#}");
    assert_eq!(first["figures"][0]["expected"], 0.5);
    wrong.named(&[("link_added", "", &["camera"])]);
}

#[test]
fn an_inertia_that_no_body_has_has_a_cause() {
    let wrong = Wrong::new(&[(FOREARM_INERTIA, &FOREARM_INERTIA.replacen("0.0312", "-0.0312", 1))]);
    let report = wrong.named(&[("moment_sign", "ixx", &["forearm_link"])]);
    let first = &report["dynamics"]["explanations"][0];
    let laws = names(&first["impossible_as_written"]);
    assert_eq!(laws, ["forearm_link: a principal moment of inertia is negative"]);
    // A moment that is ten times too large.
    let wrong = Wrong::new(&[(FOREARM_INERTIA, &FOREARM_INERTIA.replacen("ixx=\"0.0", "ixx=\"0.", 1))]);
    let report = wrong.named(&[("inertia_entry", "ixx", &["forearm_link"])]);
    let laws = names(&report["dynamics"]["explanations"][0]["impossible_as_written"]);
    assert!(laws[0].contains("exceeds the sum of the others"), "{laws:?}");
}

#[test]
fn a_value_that_is_not_a_number_is_one_message() {
    let wrong = Wrong::new(&[(FOREARM_MASS, "<mass value=\"nan\"/>")]);
    let answer = congruent(&["check", &text(&wrong.urdf()), "--against", &text(&original())]);
    assert_eq!(answer.code, 2);
    let expected =
        "ur5e.urdf:129: link \"forearm_link\": <mass> value = \"nan\": \"nan\" is not a finite number";
    assert!(answer.stdout.contains(expected), "{}", answer.stdout);
    assert!(!answer.stdout.contains("indistinguishable"), "{}", answer.stdout);
    assert!(!answer.stderr.contains("massless"), "{}", answer.stderr);
}

/// A robot file of the UR5e with other text at its end and in it.
fn with_robot_file(change: impl Fn(&str) -> String) -> (Wrong, PathBuf) {
    let wrong = Wrong::new(&[]);
    let file = fs::read_to_string(workspace().join("robots/ur5e/robot.toml")).unwrap();
    let changed = change(&file);
    assert_ne!(changed, file);
    let path = wrong.folder.path().join("robot.toml");
    fs::write(&path, changed).unwrap();
    (wrong, path)
}

#[test]
fn declared_accelerations_are_covered() {
    let (wrong, path) = with_robot_file(|file| {
        file.to_owned() + "\n[limits]\nacceleration_rad_s2 = { '*' = 20, elbow_joint = 5 }\n"
    });
    let urdf = fs::read_to_string(original()).unwrap().replacen(FOREARM_MASS, "<mass value=\"3.5\"/>", 1);
    fs::write(wrong.urdf(), urdf).unwrap();
    let covered = |path: &PathBuf| -> Vec<(f64, bool)> {
        let report = congruent_json(&["check", &text(path), "--against", &text(&original())]).json();
        let covered = report["dynamics"]["certificates"]["covered"].as_array().unwrap();
        let one = |of: &Value| {
            (of["acceleration"].as_f64().unwrap(), of["acceleration_is_declared"].as_bool().unwrap())
        };
        covered.iter().map(one).collect()
    };
    let expected = [20.0, 20.0, 5.0, 20.0, 20.0, 20.0].map(|value| (value, true));
    assert_eq!(covered(&path), expected);
    assert_eq!(covered(&wrong.urdf()), [(10.0, false); 6]);
    let answer = congruent(&["check", &text(&wrong.urdf()), "--against", &text(&original())]);
    assert!(answer.stdout.contains("accelerations up to 10 rad/s^2 or m/s^2 assumed"), "{}", answer.stdout);
}

#[test]
fn a_mass_may_be_declared_alone() {
    let (_wrong, path) = with_robot_file(|file| file.replacen("com_m = [0.15, 0.0, 0.0265]\n", "", 1));
    let report = congruent_json(&["check", &text(&path)]).json();
    assert_eq!(report["verdict"], "agree", "{report:#}");
    let left_out = names(&report["declared_dynamics"]["not_declared"]);
    assert!(left_out.contains(&"centre of mass of elbow_joint"), "{left_out:?}");
}

#[test]
fn a_section_that_declares_nothing_is_not_compared() {
    let (_wrong, path) = with_robot_file(|file| {
        let end = file.find("# The vendor publishes no inertia tensors").unwrap();
        file[..end].to_owned()
    });
    let report = congruent_json(&["check", &text(&path)]).json();
    let not_asked = report["not_asked"].as_array().unwrap();
    let found = not_asked.iter().find(|of| of["source"] == "declared_dynamics").unwrap();
    let message = found["findings"][0]["message"].as_str().unwrap();
    assert!(message.contains("there is nothing to compare"), "{message}");
    assert!(report["declared_dynamics"].is_null());
}

/// A hand at a fixed joint is part of the last link's body: an origin that is the same within the tolerance shifts its mass, which
/// is no difference of masses; and a mass that differs beside it is still named.
#[test]
fn a_tolerated_origin_of_a_fixed_joint_is_no_difference_of_torques() {
    let original = workspace().join("robots/panda/panda.urdf");
    let urdf = fs::read_to_string(&original).unwrap();
    let hand = "<origin xyz=\"0 0 0\" rpy=\"0 0 -0.7853981633974483\"/>";
    assert_eq!(urdf.matches(hand).count(), 1);
    let shifted = urdf.replace(hand, "<origin xyz=\"0 0 0.00005\" rpy=\"0 0 -0.7854\"/>");
    let folder = tempfile::tempdir().unwrap();
    let check = |urdf: &str| {
        let path = folder.path().join("panda.urdf");
        fs::write(&path, urdf).unwrap();
        congruent_json(&[
            "check",
            &text(&path),
            "--against",
            &text(&original),
            "--tolerance",
            "0.1mm,0.01deg",
        ])
    };
    let same = check(&shifted);
    assert_eq!(same.code, 0, "{}", same.stdout);
    let mass = "<mass value=\"";
    let at = shifted.find("<link name=\"panda_link5\"").unwrap();
    let at = at + shifted[at..].find(mass).unwrap() + mass.len();
    let heavier = format!("{}1{}", &shifted[..at], &shifted[at..]);
    let answer = check(&heavier);
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let report = answer.json();
    let cause = &report["dynamics"]["explanations"][0];
    assert_eq!(names(&cause["place"]), ["panda_link5"], "{report:#}");
}

/// Two files of other chains: the mass in grams is named beside the flip and the length, though centres of mass are not compared.
#[test]
fn masses_are_compared_behind_joints_that_are_placed_elsewhere() {
    let wrong = Wrong::new(&[
        ("xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.4322 0 0.1333\""),
        (FOREARM_MASS, "<mass value=\"2846\"/>"),
    ]);
    let line = congruent(&["check", "-q", &text(&wrong.urdf()), "--against", &text(&original())]).stdout;
    assert!(line.contains("joint \"wrist_1_joint\": origin"), "{line}");
    assert!(line.contains("forearm_link: mass 2846 kg in "), "{line}");
    assert!(line.contains("a factor of 1000, grams?"), "{line}");
}

/// A limit that one file has for all joints is a placeholder, and nothing to write; a speed that a robot has at all joints is not.
#[test]
fn one_effort_for_all_joints_is_no_value_to_write() {
    let mut efforts = fs::read_to_string(original()).unwrap();
    for effort in ["150", "28"] {
        efforts = efforts.replace(&format!("effort=\"{effort}\""), "effort=\"2000\"");
    }
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.urdf");
    fs::write(&other, efforts).unwrap();
    let answer = congruent(&["check", &text(&original()), "--against", &text(&other)]);
    assert_eq!(answer.code, 1);
    let printed = answer.stdout;
    assert!(printed.contains("other.urdf has it for all joints, a placeholder?"), "{printed}");
    assert!(!printed.contains("N mm") && !printed.contains("to write"), "{printed}");
}

/// The file that has the rotation of an inertial frame is not asked to drop it.
#[test]
fn a_rotation_that_the_other_file_lacks_is_said_to_be_missing_there() {
    let wrong = Wrong::new(&[(
        "<origin xyz=\"-0.2422 0 0.0265\" rpy=\"0 1.5707963267948966 0\"/>",
        "<origin xyz=\"-0.2422 0 0.0265\"/>",
    )]);
    let line = congruent(&["check", "-q", &text(&original()), "--against", &text(&wrong.urdf())]).stdout;
    assert!(line.contains("the other file lacks the rotation of the inertial frame"), "{line}");
}

/// Two links with each other's mass are one mistake, whatever else differs.
#[test]
fn exchanged_masses_are_one_cause() {
    let mass = |mass: &str| format!("<mass value=\"{mass}\"/>");
    let urdf = fs::read_to_string(original()).unwrap();
    let urdf = urdf
        .replace(&mass("8.058"), "THIS")
        .replace(FOREARM_MASS, &mass("8.058"))
        .replace("THIS", FOREARM_MASS);
    for (also, causes) in [("3.761", 1), ("3.9", 2)] {
        let wrong = Wrong::new(&[]);
        fs::write(wrong.urdf(), urdf.replace(&mass("3.761"), &mass(also))).unwrap();
        let line = congruent(&["check", "-q", &text(&wrong.urdf()), "--against", &text(&original())]).stdout;
        assert!(
            line.contains("upper_arm_link, forearm_link: the masses of two links are exchanged"),
            "{line}"
        );
        assert_eq!(line.contains("shoulder_link: the mass is off"), causes == 2, "{line}");
    }
}
