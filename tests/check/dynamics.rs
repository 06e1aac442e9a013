//! `congruent check` on masses, inertias and joint terms: against another URDF, against `[[inertial]]` entries of the
//! robot file, and against the physics. The cause, the link and the line are right, and what is suggested, put into the
//! file, makes the check agree.

use std::{fs, path::PathBuf};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent, congruent_json, text},
    corpus::workspace,
    suggested_changes::{apply, names},
};

/// A copy of a robot of the repository, in which files can be changed.
struct RobotCopy {
    folder: tempfile::TempDir,
    name: &'static str,
}

impl RobotCopy {
    fn of(name: &'static str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let original = workspace().join("robots").join(name);
        for entry in fs::read_dir(original).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
            }
        }
        Self { folder, name }
    }

    fn urdf(&self) -> PathBuf {
        self.folder.path().join(self.name).with_extension("urdf")
    }

    fn robot_file(&self) -> PathBuf {
        self.folder.path().join("robot.toml")
    }

    /// Changes the part of the URDF from a link's or joint's name to the end of that element.
    #[track_caller]
    fn change(&self, element: &str, name: &str, change: impl Fn(&str) -> String) -> &Self {
        let text = fs::read_to_string(self.urdf()).unwrap();
        let start = text.find(&format!("<{element} name=\"{name}\"")).unwrap();
        let end = start + text[start..].find(&format!("</{element}>")).unwrap();
        let changed = change(&text[start..end]);
        assert_ne!(changed, text[start..end], "nothing has changed in {name}");
        fs::write(self.urdf(), [&text[..start], &changed, &text[end..]].concat()).unwrap();
        self
    }

    #[track_caller]
    fn replace(&self, element: &str, name: &str, old: &str, new: &str) -> &Self {
        self.change(element, name, |text| text.replacen(old, new, 1))
    }

    fn against_original(&self) -> Answer {
        let original = workspace().join("robots").join(self.name).join(self.name).with_extension("urdf");
        congruent_json(&["check", &text(&self.urdf()), "--against", &text(&original)])
    }

    fn against_declared(&self) -> Answer {
        congruent_json(&["check", &text(&self.robot_file())])
    }
}

/// The explanation that must be the first one.
#[track_caller]
fn explained<'a>(report: &'a Value, cause: &str, place: &[&str]) -> &'a Value {
    let dynamics = &report["dynamics"];
    assert_eq!(dynamics["verdict"], "explained", "{dynamics:#}");
    let first = &dynamics["explanations"][0];
    assert_eq!(first["cause"], cause, "{first:#}");
    assert_eq!(names(&first["place"]), place, "{first:#}");
    first
}

/// The line of a file that an explanation names.
fn line_of(explanation: &Value) -> String {
    let path = explanation["file"].as_str().unwrap();
    let number = usize::try_from(explanation["line"].as_u64().unwrap()).unwrap();
    fs::read_to_string(path).unwrap().lines().nth(number - 1).unwrap().to_owned()
}

/// A wrong URDF against the right one: what is said, and that doing it makes them agree.
#[track_caller]
fn corrected(robot: &RobotCopy, cause: &str, place: &[&str], line: &str) {
    let answer = robot.against_original();
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let report = answer.json();
    assert_eq!(report["verdict"], "disagree");
    let first = explained(&report, cause, place);
    assert_eq!(first["file"], text(&robot.urdf()));
    assert!(line_of(first).contains(line), "{} has no {line}", line_of(first));
    let figure = &first["figures"][0];
    assert!(figure["line"].is_u64() && figure["expected_line"].is_u64(), "{figure:#}");
    apply(&report["dynamics"]["explanations"]);
    let answer = robot.against_original();
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    assert_eq!(answer.json()["dynamics"]["verdict"], "same");
}

#[test]
fn a_wrong_mass() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("link", "forearm_link", "<mass value=\"2.846\"", "<mass value=\"2.275\"");
    corrected(&robot, "mass", &["forearm_link"], "<mass value=\"2.275\"");
}

#[test]
fn a_centre_of_mass_in_millimetres() {
    let robot = RobotCopy::of("ur5e");
    robot.replace(
        "link",
        "wrist_1_link",
        "<origin xyz=\"0 -0.01634 -0.0018\"",
        "<origin xyz=\"0 -16.34 -1.8\"",
    );
    corrected(&robot, "com_unit", &["wrist_1_link"], "xyz=\"0 -16.34 -1.8\"");
}

#[test]
fn products_with_the_other_sign() {
    let robot = RobotCopy::of("panda");
    robot.change("link", "panda_link4", |text| {
        let start = text.find("<inertia ").unwrap();
        let (before, tensor) = text.split_at(start);
        let flipped = ["ixy", "ixz", "iyz"].into_iter().fold(tensor.to_owned(), |tensor, product| {
            let (old, new) = (format!("{product}=\""), format!("{product}=\"-"));
            tensor.replacen(&old, &new, 1).replace("=\"--", "=\"")
        });
        before.to_owned() + &flipped
    });
    corrected(&robot, "products_sign", &["panda_link4"], "<inertia ");
}

#[test]
fn an_inertia_about_the_links_origin() {
    let robot = RobotCopy::of("ur5e");
    // wrist 3: 0.365 kg, 1.159 mm along z.
    robot.change("link", "wrist_3_link", |text| text.replace("9.89041400833e-05", "9.93944376483e-05"));
    corrected(&robot, "inertia_about_origin", &["wrist_3_link"], "<inertia ");
}

#[test]
fn two_links_with_each_others_inertia() {
    let robot = RobotCopy::of("ur5e");
    let inertial = |text: &str| {
        let start = text.find("<inertial>").unwrap();
        let end = text.find("</inertial>").unwrap();
        text[start..end].to_owned()
    };
    let text = fs::read_to_string(robot.urdf()).unwrap();
    let of = |link: &str| inertial(&text[text.find(&format!("<link name=\"{link}\"")).unwrap()..]);
    let [upper, fore] = ["upper_arm_link", "forearm_link"].map(of);
    robot.replace("link", "upper_arm_link", &upper, &fore).replace("link", "forearm_link", &fore, &upper);
    corrected(&robot, "inertials_swapped", &["upper_arm_link", "forearm_link"], "<mass ");
}

#[test]
fn damping_that_is_left_out() {
    let robot = RobotCopy::of("panda");
    let text = fs::read_to_string(robot.urdf()).unwrap();
    fs::write(robot.urdf(), text.replace("<dynamics damping=\"0.003\"/>", "")).unwrap();
    let answer = robot.against_original();
    let report = answer.json();
    let first = &report["dynamics"]["explanations"][0];
    assert!(
        ["damping", "damping_missing", "joint_terms_missing"].contains(&first["cause"].as_str().unwrap()),
        "{first:#}"
    );
    apply(&report["dynamics"]["explanations"]);
    let answer = robot.against_original();
    assert_eq!(answer.code, 0, "{}", answer.stdout);
}

#[test]
fn a_vendors_table_agrees_with_the_urdf() {
    let report = RobotCopy::of("ur5e").against_declared().json();
    assert_eq!(report["verdict"], "agree", "{report:#}");
    let left_out = names(&report["declared_dynamics"]["not_declared"]);
    assert!(left_out.contains(&"inertia of all joints"), "{left_out:?}");
    // The URDF against the table, and the URDF against the physics.
    assert_eq!(report["other_dynamics"].as_array().unwrap().len(), 1);
    assert_eq!(report["other_dynamics"][0]["sides"]["reference"], "physics");
}

/// A robot file in which one text is another: the cause, the joint's link, and the line that is wrong.
#[track_caller]
fn declared(old: &str, new: &str, cause: &str, place: &str, line: &str) {
    let robot = RobotCopy::of("ur5e");
    let file = fs::read_to_string(robot.robot_file()).unwrap();
    assert!(file.contains(old));
    fs::write(robot.robot_file(), file.replacen(old, new, 1)).unwrap();
    let answer = robot.against_declared();
    assert_eq!(answer.code, 1, "{}", answer.stdout);
    let report = answer.json();
    let first = explained(&report, cause, &[place]);
    assert_eq!(first["file"], text(&robot.robot_file()), "{first:#}");
    assert!(line_of(first).contains(line), "{} has no {line}", line_of(first));
    apply(&report["dynamics"]["explanations"]);
    let answer = robot.against_declared();
    assert_eq!(answer.code, 0, "{}", answer.stdout);
}

#[test]
fn a_mistake_in_the_table_is_found_there() {
    declared(
        "com_m = [0.15, 0.0, 0.0265]",
        "com_m = [150, 0.0, 26.5]",
        "com_unit",
        "forearm_link",
        "com_m = [150",
    );
    declared("mass_kg = 1.37", "mass_kg = 1370", "mass_unit", "wrist_1_link", "mass_kg = 1370");
}

#[test]
fn a_centre_of_mass_in_the_tables_frame_is_named() {
    let robot = RobotCopy::of("ur5e");
    // The vendor's figures, which are those of the table's frame 3, in the frame of the link.
    robot.replace(
        "link",
        "forearm_link",
        "<origin xyz=\"-0.2422 0 0.0265\"",
        "<origin xyz=\"0.15 0 0.0265\"",
    );
    let report = robot.against_declared().json();
    let first = explained(&report, "com_frame", &["forearm_link"]);
    assert_eq!(first["detail"], "dh3");
    apply(&report["dynamics"]["explanations"]);
    assert_eq!(robot.against_declared().code, 0);
}

#[test]
fn masses_in_frames_of_a_wrong_table_are_not_compared() {
    let robot = RobotCopy::of("ur5e");
    let file = fs::read_to_string(robot.robot_file()).unwrap();
    fs::write(robot.robot_file(), file.replacen("d_m = 0.0997", "d_m = 0.1027", 1)).unwrap();
    let report = robot.against_declared().json();
    assert_eq!(report["dynamics"]["sides"]["reference"], "physics");
    assert_eq!(report["not_asked"][0]["source"], "declared_dynamics", "{report:#}");
}

#[test]
fn a_frame_that_does_not_move_with_its_joint_is_no_agreement() {
    let robot = RobotCopy::of("ur5e");
    let file = fs::read_to_string(robot.robot_file()).unwrap();
    fs::write(robot.robot_file(), file.replacen("frame = \"dh3\"", "frame = \"dh2\"", 1)).unwrap();
    let answer = robot.against_declared();
    let finding = &answer.json()["findings"][0];
    assert_eq!((answer.code, &finding["severity"]), (2, &"error".into()), "{finding}");
    assert!(finding["message"].as_str().unwrap().contains("\"dh2\""), "{finding}");
}

#[test]
fn a_link_that_is_only_turned_is_the_one_that_is_named() {
    let robot = RobotCopy::of("ur5e");
    let of_tool = "rpy=\"1.5707963267948966 0 1.5707963267948966\"";
    robot.replace("joint", "flange-tool0", of_tool, "rpy=\"1.5 0 1.5\"");
    assert_eq!(robot.against_original().json()["worst"]["link"], "tool0");
}

#[test]
fn gravity_in_another_direction() {
    let gravity = |value: &str| format!("[dynamics]\ngravity_m_s2 = {value}");
    declared("[dynamics]", &gravity("[0, -9.81, 0]"), "gravity_direction", "gravity", "gravity_m_s2");
    declared("[dynamics]", &gravity("[0, 0, 9.81]"), "gravity_sign", "gravity", "gravity_m_s2");
}

#[test]
fn a_wrong_urdf_is_corrected_by_the_table() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("link", "forearm_link", "<mass value=\"2.846\"", "<mass value=\"2846\"");
    let answer = robot.against_declared();
    assert_eq!(answer.code, 1);
    let report = answer.json();
    let first = explained(&report, "mass_unit", &["forearm_link"]);
    assert_eq!(first["file"], text(&robot.urdf()));
    apply(&report["dynamics"]["explanations"]);
    assert_eq!(robot.against_declared().code, 0);
}

/// An origin that is 10 mm off, and a mass in grams: both are named.
#[test]
fn masses_behind_an_origin_that_is_a_little_off_are_compared_as_written() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("joint", "elbow_joint", "-0.425", "-0.435");
    let report = robot.against_original().json();
    assert_eq!(report["diagnosis"][0]["cause"], "joint_origin", "{report}");
    assert_eq!(report["dynamics"]["verdict"], "same", "{report}");
    robot.replace("link", "forearm_link", "<mass value=\"2.846\"", "<mass value=\"2846\"");
    let report = robot.against_original().json();
    assert_eq!(report["diagnosis"][0]["cause"], "joint_origin", "{report}");
    explained(&report, "mass_unit", &["forearm_link"]);
}

#[test]
fn another_chain_is_not_compared_and_the_first_joint_is_named() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("joint", "elbow_joint", "-0.425", "-0.475");
    let answer = robot.against_original();
    assert_eq!(answer.code, 1);
    let report = answer.json();
    let why = report["against"]["dynamics_not_compared"].as_str().unwrap();
    assert!(why.contains("joint \"elbow_joint\" is the first"), "{why}");
    let pair =
        report["comparisons"].as_array().unwrap().iter().find(|of| of["name"] == "urdf_other").unwrap();
    assert_eq!(pair["verdict"], "disagree");
    let panda = workspace().join("robots/panda/panda.urdf");
    let answer = congruent_json(&["check", &text(&robot.urdf()), "--against", &text(&panda)]);
    assert_eq!(answer.code, 1);
    let report = answer.json();
    let why = report["against"]["dynamics_not_compared"].as_str().unwrap();
    assert!(why.contains("shoulder_pan_joint"), "{why}");
}

#[test]
fn what_no_torque_shows_and_limits() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("link", "shoulder_link", "xyz=\"0 -0.00193 -0.02561\"", "xyz=\"0 -0.00193 0.5\"");
    let answer = robot.against_original();
    assert_eq!(answer.code, 0, "{}", answer.stdout);
    let report = answer.json();
    let hidden = &report["dynamics"]["hidden_differences"][0];
    assert_eq!([&hidden["of"], &hidden["figure"]], ["shoulder_link", "com_z"]);
    let printed = congruent(&[
        "check",
        &text(&robot.urdf()),
        "--against",
        &text(&workspace().join("robots/ur5e/ur5e.urdf")),
    ]);
    assert!(printed.stdout.contains("it has no effect on joint torques"), "{}", printed.stdout);
    robot.change("joint", "elbow_joint", |text| {
        let start = text.find("velocity=\"").unwrap() + "velocity=\"".len();
        let end = start + text[start..].find('"').unwrap();
        let degrees = text[start..end].parse::<f64>().unwrap().to_degrees();
        format!("{}{degrees:?}{}", &text[..start], &text[end..])
    });
    let answer = robot.against_original();
    assert_eq!(answer.code, 1);
    let report = answer.json();
    let limit = &report["dynamics"]["limits"][0];
    assert_eq!(
        [&limit["joint"], &limit["cause"], &limit["detail"]],
        ["elbow_joint", "velocity_limit", "degrees"]
    );
}

#[test]
fn ci_reads_the_cause() {
    let robot = RobotCopy::of("ur5e");
    robot.replace("link", "forearm_link", "<mass value=\"2.846\"", "<mass value=\"2846\"");
    let junit = robot.folder.path().join("junit.xml");
    let answer = congruent(&["check", &text(&robot.robot_file()), "--junit", &text(&junit)]);
    assert_eq!(answer.code, 1);
    let written = fs::read_to_string(junit).unwrap();
    assert!(written.contains("<failure type=\"mass_unit\"") || written.contains("mass_unit"), "{written}");
    assert!(written.contains("forearm_link: the mass is given in another unit (g)"), "{written}");
}

#[test]
fn a_robot_without_masses_is_compared_without_its_forces() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("light.urdf");
    fs::write(
        &urdf,
        "<robot name='light'><link name='base'/><link name='arm'/><joint name='turn' type='continuous'>\
         <parent link='base'/><child link='arm'/></joint></robot>",
    )
    .unwrap();
    let report = congruent_json(&["check", &text(&urdf)]).json();
    assert!(report["dynamics"].is_null());
    assert_eq!(report["not_asked"][0]["source"], "simulated_dynamics", "{report:#}");
}

#[test]
fn base_parameters_are_those_that_torques_identify() {
    for (robot, seen, of) in [("ur5e", 36, 60), ("panda", 51, 90), ("rrr_arm", 30, 60)] {
        let path = workspace().join("robots").join(robot);
        let report =
            congruent_json(&["dynamics", &text(&path), "--base-parameters", "--free-followers"]).json();
        assert_eq!(report["base_parameters"].as_array().unwrap().len(), seen, "{robot}");
        assert_eq!(report["of"], of, "{robot}");
        let checked = congruent_json(&["check", &text(&path)]).json();
        assert_eq!(checked["dynamics"]["seen"]["numbers"], seen, "{robot}");
    }
    let printed = congruent(&["dynamics", "robots/ur5e", "--base-parameters"]).stdout;
    assert!(printed.contains("wrist_2_link my + wrist_3_link mz + 0.0996 wrist_3_link m"), "{printed}");
    let both = congruent(&["dynamics", "robots/ur5e", "--base-parameters", "--friction"]);
    assert_eq!(both.code, 2);
}
