//! `congruent check --against`: joints whose origin or axis is another one in the other URDF. What is named is where the
//! fault was put, and what is suggested makes the two agree.

use std::{fs, path::PathBuf};

use serde_json::{Value, json};

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    scratch_folder::ScratchFolder,
};

/// A fitted length or angle: rounding of products of poses.
const ROUNDING: f64 = 1e-12;

fn urdf(robot: &str) -> String {
    fs::read_to_string(workspace().join(robot)).unwrap()
}

/// The text with the first `from` behind `mark` replaced.
#[track_caller]
fn changed(text: &str, (mark, from, to): (&str, &str, &str)) -> String {
    let start = text.find(mark).unwrap_or_else(|| panic!("no {mark}"));
    let at = start + text[start..].find(from).unwrap_or_else(|| panic!("no {from} behind {mark}"));
    format!("{}{to}{}", &text[..at], &text[at + from.len()..])
}

/// A wrong URDF and the right one.
struct Pair {
    scratch: ScratchFolder,
    wrong: String,
    right: String,
}

impl Pair {
    fn new(wrong: &str, right: &str) -> Self {
        let scratch = ScratchFolder::new();
        let [wrong, right] =
            [("wrong.urdf", wrong), ("right.urdf", right)].map(|(name, urdf)| scratch.write(name, urdf));
        Self { scratch, wrong, right }
    }

    fn check(&self, wrong: &str) -> Value {
        let answer = congruent_json(&["check", wrong, "--against", &self.right]);
        assert!(answer.code < 2, "{}{}", answer.stdout, answer.stderr);
        answer.json()
    }

    /// The faults of the first cause, which explains everything, after what they say was written.
    #[track_caller]
    fn faults(&self) -> Vec<Value> {
        let report = self.check(&self.wrong);
        assert_eq!(report["verdict"], "disagree");
        let cause = report["diagnosis"][0].clone();
        assert_eq!(cause["within_tolerance"], true, "{cause:#}");
        let faults = cause["parts"].as_array().cloned().unwrap_or_else(|| vec![cause]);
        let mut text = fs::read_to_string(&self.wrong).unwrap();
        let changes = faults.iter().flat_map(|fault| fault["changes"].as_array().unwrap().clone());
        let mut changes: Vec<Value> = changes.collect();
        changes.sort_by_key(|change| std::cmp::Reverse(change["from_line"].as_u64()));
        for change in changes {
            let [from, to] =
                ["from_line", "to_line"].map(|key| usize::try_from(change[key].as_u64().unwrap()).unwrap());
            let mut lines: Vec<&str> = text.lines().collect();
            lines.splice(from - 1..to, [change["text"].as_str().unwrap()]);
            text = lines.join("\n");
        }
        let corrected = self.scratch.write("corrected.urdf", &text);
        let report = self.check(&corrected);
        let pair = report["comparisons"].as_array().unwrap().iter().find(|of| of["name"] == "urdf_other");
        assert_eq!(pair.unwrap()["verdict"], "agree", "{text}");
        faults
    }
}

/// The only fault: an origin of this joint, with these attributes.
#[track_caller]
fn only_origin(pair: &Pair, joint: &str, parameter: &str) -> Value {
    let faults = pair.faults();
    let [fault] = &faults[..] else { panic!("{faults:#?}") };
    assert_eq!(fault["cause"], "joint_origin", "{fault:#}");
    assert_eq!([&fault["joint"], &fault["parameter"]], [joint, parameter], "{fault:#}");
    assert_eq!([&fault["file"], &fault["expected_file"]], [&*pair.wrong, &*pair.right], "{fault:#}");
    let line = |file: &str, line: &Value| {
        let number = usize::try_from(line.as_u64().unwrap()).unwrap();
        fs::read_to_string(file).unwrap().lines().nth(number - 1).unwrap().to_owned()
    };
    for (file, key) in [(&pair.wrong, "line"), (&pair.right, "expected_line")] {
        let shown = line(file, &fault[key]);
        assert!(shown.contains("<origin") || shown.contains("<joint"), "{key}: {shown}");
    }
    fault.clone()
}

#[track_caller]
fn near(found: &Value, expected: [f64; 3]) {
    for (found, expected) in found.as_array().unwrap().iter().zip(expected) {
        assert!((found.as_f64().unwrap() - expected).abs() < ROUNDING, "{found} not {expected}");
    }
}

#[test]
fn two_and_six_numbers_of_an_origin_of_the_ur5e() {
    let right = urdf("robots/ur5e/ur5e.urdf");
    let elbow = "<joint name=\"elbow_joint\"";
    let two = changed(&right, (elbow, "xyz=\"-0.425 0 0\"", "xyz=\"-0.426 0.002 0\""));
    let fault = only_origin(&Pair::new(&two, &right), "elbow_joint", "xyz");
    assert_eq!([&fault["found"], &fault["expected"]], ["xyz=\"-0.426 0.002 0\"", "xyz=\"-0.425 0 0\""]);
    near(&fault["translation_m"], [-0.001, 0.002, 0.0]);
    near(&fault["rotation_rad"], [0.0; 3]);
    let six = "xyz=\"-0.426 0.002 0.003\" rpy=\"0.01 -0.02 0.03\"";
    let six = changed(&right, (elbow, "xyz=\"-0.425 0 0\"", six));
    let fault = only_origin(&Pair::new(&six, &right), "elbow_joint", "xyz, rpy");
    assert_eq!(fault["found"], "xyz=\"-0.426 0.002 0.003\" rpy=\"0.01 -0.02 0.03\"");
    near(&fault["translation_m"], [-0.001, 0.002, 0.003]);
}

/// A folder with a table counts by its URDF against another one.
#[test]
fn a_robot_file_against_a_urdf() {
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("ur5e", &[]);
    let right = urdf("robots/ur5e/ur5e.urdf");
    let path = PathBuf::from(&robot).join("ur5e.urdf");
    let path = if path.is_file() { path } else { PathBuf::from(&robot).with_file_name("ur5e.urdf") };
    fs::write(&path, changed(&right, ("<joint name=\"elbow_joint\"", "-0.425 0 0", "-0.425 0.001 0.002")))
        .unwrap();
    let report =
        congruent_json(&["check", &robot, "--against", &text(&workspace().join("robots/ur5e/ur5e.urdf"))])
            .json();
    let diagnoses = report["diagnoses"].as_array().unwrap();
    let of = |name: &str| diagnoses.iter().find(|of| of["name"] == name).unwrap()["causes"][0].clone();
    assert_eq!([&of("urdf_other")["cause"], &of("urdf_other")["joint"]], ["joint_origin", "elbow_joint"]);
    assert!(!of("model_urdf")["cause"].is_null());
}

/// The arm of the guide, one change in it.
#[track_caller]
fn arm(change: (&str, &str, &str)) -> Pair {
    let right = urdf("docs/examples/arm/arm.urdf");
    Pair::new(&changed(&right, change), &right)
}

#[test]
fn fixed_joints_at_both_ends_are_named_by_their_own_name() {
    let base = ("name=\"base_plate\"", "0.02 0 0.1", "0.021 0.003 0.1");
    only_origin(&arm(base), "base_plate", "xyz");
    let mount = ("name=\"mount\"", "rpy=\"0.3490658503988659", "rpy=\"0.3590658503988659");
    let fault = only_origin(&arm(mount), "mount", "rpy");
    assert_eq!(fault["found"], "rpy=\"0.3590658503988659 -0.6108652381980153 0.8726646259971648\"");
}

/// A fixed joint between two moving ones has a link that the other file calls otherwise: the joint goes by its name.
#[test]
fn a_fixed_joint_between_moving_ones_whose_link_has_another_name() {
    let right = urdf("docs/examples/arm/arm.urdf");
    let wrong = changed(&right, ("name=\"base_plate\"", "0.02 0 0.1", "0.02 0.01 0.1"));
    let pair = Pair::new(&wrong.replace("\"pedestal\"", "\"socket\""), &right);
    let fault = only_origin(&pair, "base_plate", "xyz");
    near(&fault["translation_m"], [0.0, 0.01, 0.0]);
    let report = pair.check(&pair.wrong);
    assert_eq!(report["indistinguishable"], json!([]));
}

/// The other file lacks the fixed joint: the fault may be in either, and both are reported.
#[test]
fn a_fixed_joint_that_one_file_lacks_is_an_alternative() {
    let right = urdf("docs/examples/arm/arm.urdf");
    let between = "<link name=\"mid\"/><joint name=\"adapter\" type=\"fixed\"><parent link=\"upper_arm\"/>\
        <child link=\"mid\"/><origin xyz=\"0.1 0.002 0\"/></joint>\n<link name=\"tool\"/>";
    let wrong = changed(&right, ("", "<link name=\"tool\"/>", between));
    let wrong = changed(&wrong, ("name=\"bend\"", "parent link=\"upper_arm\"", "parent link=\"mid\""));
    let pair = Pair::new(&changed(&wrong, ("name=\"bend\"", "0.35 0 0.06", "0.25 0 0.06")), &right);
    let faults = pair.faults();
    assert_eq!([&faults[0]["joint"], &faults[0]["expected"]], ["bend", "xyz=\"0.25 -0.002 0.06\""]);
    let report = pair.check(&pair.wrong);
    let other = &report["indistinguishable"][0];
    assert_eq!([&other["joint"], &other["expected"]], ["adapter", "xyz=\"0.1 0 0\""], "{other:#}");
}

#[test]
fn an_origin_in_another_unit_is_reported() {
    let degrees = arm(("name=\"lift\"", "rpy=\"1.5707963267948966 0 0\"", "rpy=\"90 0 0\""));
    let fault = only_origin(&degrees, "lift", "rpy");
    assert!(fault["message"].as_str().unwrap().ends_with(": the rpy is in degrees"), "{fault:#}");
    let millimetres = arm(("name=\"bend\"", "0.35 0 0.06", "350 0 60"));
    let fault = only_origin(&millimetres, "bend", "xyz");
    assert!(fault["message"].as_str().unwrap().ends_with(": the xyz is in millimetres"), "{fault:#}");
}

#[test]
fn an_origin_that_is_left_out_is_put_in() {
    let pair = arm(("name=\"bend\"", "<origin xyz=\"0.35 0 0.06\"/>", ""));
    assert_eq!(only_origin(&pair, "bend", "xyz")["found"], "xyz=\"0 0 0\"");
}

#[test]
fn the_origin_and_the_axis_of_one_joint() {
    let right = urdf("docs/examples/arm/arm.urdf");
    let wrong = changed(
        &right,
        ("name=\"bend\"", "<origin xyz=\"0.35 0 0.06\"/>", "<origin xyz=\"0.352 0.001 0.06\"/>"),
    );
    let pair =
        Pair::new(&changed(&wrong, ("name=\"bend\"", "<axis xyz=\"0 0 1\"", "<axis xyz=\"0 1 0\"")), &right);
    let faults = pair.faults();
    let named: Vec<[&Value; 3]> =
        faults.iter().map(|fault| [&fault["cause"], &fault["joint"], &fault["found"]]).collect();
    let expected =
        [["joint_axis", "bend", "xyz=\"0 1 0\""], ["joint_origin", "bend", "xyz=\"0.352 0.001 0.06\""]];
    assert_eq!(named, expected);
    let flipped = arm(("name=\"bend\"", "<axis xyz=\"0 0 1\"", "<axis xyz=\"0 0 -1\""));
    assert_eq!([&flipped.faults()[0]["cause"], &flipped.faults()[0]["joint"]], ["axis_flipped", "bend"]);
}

/// All joints of a cylindrical arm: one turns, two slide.
#[test]
fn a_sliding_joint_and_two_joints_at_once() {
    let right = urdf("robots/cylindrical_rpp/cylindrical_rpp.urdf");
    let joints: Vec<&str> =
        right.split("<joint ").skip(1).filter(|text| text.contains("\"prismatic\"")).collect();
    let name = |joint: &str| joint.split('"').nth(1).unwrap().to_owned();
    let names: Vec<String> = joints.iter().map(|joint| name(joint)).collect();
    let moved = |text: &str, joint: &str, by: &str| {
        let start = text.find(&format!("<joint name=\"{joint}\"")).unwrap();
        let end = start + text[start..].find("</joint>").unwrap();
        let body = &text[start..end];
        let without: String = match body.find("<origin") {
            Some(at) => body[..at].to_owned() + &body[at + body[at..].find("/>").unwrap() + 2..],
            None => body.to_owned(),
        };
        format!("{}{without}{by}{}", &text[..start], &text[end..])
    };
    let one = moved(&right, &names[0], "<origin xyz=\"0.01 0.02 0.3\" rpy=\"0.1 0 0\"/>");
    let faults = Pair::new(&one, &right).faults();
    assert_eq!(faults.len(), 1, "{faults:#?}");
    assert_eq!([&faults[0]["cause"], &faults[0]["joint"]], ["joint_origin", names[0].as_str()]);
    let two = moved(&one, &names[1], "<origin xyz=\"0 0.001 0.2\" rpy=\"0 0 0.2\"/>");
    let faults = Pair::new(&two, &right).faults();
    let mut found: Vec<&str> = faults.iter().map(|fault| fault["joint"].as_str().unwrap()).collect();
    found.sort_unstable();
    let mut expected: Vec<&str> = names.iter().map(String::as_str).collect();
    expected.sort_unstable();
    assert_eq!(found, expected);
}

/// A finger is no part of the chain from base to tip.
#[test]
fn a_joint_beside_the_chain() {
    let right = urdf("robots/panda/panda.urdf");
    let finger = "<joint name=\"panda_finger_joint2\"";
    let start = right.find(finger).unwrap();
    let origin = start + right[start..].find("xyz=\"").unwrap();
    let end = origin + 5 + right[origin + 5..].find('"').unwrap();
    let wrong = format!("{}xyz=\"0.001 0.002 0.0594{}", &right[..origin], &right[end..]);
    only_origin(&Pair::new(&wrong, &right), "panda_finger_joint2", "xyz");
}

/// A frame that lies elsewhere in its link and is taken back in the next joint moves nothing else.
#[test]
fn a_frame_that_lies_elsewhere_has_no_cause_and_hides_none() {
    let right = urdf("docs/examples/arm/arm.urdf");
    let slid = changed(&right, ("name=\"lift\"", "0.04 0 0.3", "0.04 -0.01 0.3"));
    let slid = changed(&slid, ("name=\"bend\"", "0.35 0 0.06", "0.35 0 0.05"));
    let pair = Pair::new(&slid, &right);
    assert_eq!(pair.check(&pair.wrong)["diagnosis"], json!([]));
    let pair = Pair::new(&changed(&slid, ("name=\"roll\"", "0.05 0 0.025", "0.05 0.003 0.024")), &right);
    let cause = pair.check(&pair.wrong)["diagnosis"][0].clone();
    assert_eq!([&cause["cause"], &cause["joint"]], ["joint_origin", "roll"], "{cause:#}");
}

#[test]
fn people_see_both_lines_and_what_to_write() {
    let pair = arm(("name=\"bend\"", "0.35 0 0.06", "0.352 0.001 0.06"));
    let printed = congruent(&["check", &pair.wrong, "--against", &pair.right]).stdout;
    let printed = printed.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    for expected in [
        "URDF chain against other URDF: after one correction poses differ by 0 mm",
        "joint \"bend\": origin xyz=\"0.352 0.001 0.06\", expected xyz=\"0.35 0 0.06\" as in",
        "to write: <origin xyz=\"0.35 0 0.06\"/> # line 59",
    ] {
        assert!(printed.contains(expected), "{printed}");
    }
}

/// A file without inertias and shapes, as many kinematic descriptions are: its frames may lie anywhere only if the joints move
/// all links alike, and an origin that is off is none of them.
#[test]
fn an_origin_of_a_bare_file_is_named_beside_rounded_quarter_turns() {
    let joint = |number: usize, xyz: &str, rpy: &str| {
        format!(
            "<link name='link_{number}'/><joint name='joint_{number}' type='revolute'><parent link='link_{}'/><child \
             link='link_{number}'/><origin xyz='{xyz}' rpy='{rpy}'/><axis xyz='0 0 1'/><limit lower='-2.6' upper='2.5' effort='9' \
             velocity='2'/></joint>",
            number - 1
        )
    };
    // Lengths of the TM5-900: https://www.tm-robot.com, hardware manual.
    let arm = |elbow: &str, quarter: &str| {
        let turns = |rpy: &str| rpy.replace('q', quarter);
        [
            joint(1, "0 0 0.1452", "0 0 0"),
            joint(2, "0 0 0", &turns("-q -q 0")),
            joint(3, elbow, "0 0 0"),
            joint(4, "0.4115 0 -0.1222", &turns("0 0 q")),
            joint(5, "0 -0.106 0", &turns("q 0 0")),
            joint(6, "0 0.1144 0", &turns("-q 0 0")),
        ]
        .join("\n")
    };
    let robot = |joints: &str| {
        format!(
            "<robot name='arm'>\n<link name='link_0'/>\n{joints}\n<link name='tool0'/><joint name='flange' \
             type='fixed'><parent link='link_6'/><child link='tool0'/></joint></robot>"
        )
    };
    let right = robot(&arm("0.429 0 0", "1.5707963267948966"));
    for quarter in ["1.5707963267948966", "1.570796", "1.5708"] {
        let pair = Pair::new(&robot(&arm("0.429 0.01 0", quarter)), &right);
        // Quarter turns with fewer digits are rounding, and no causes.
        let faults = pair.faults();
        assert_eq!((&faults[0]["cause"], &faults[0]["joint"]), (&json!("joint_origin"), &json!("joint_3")));
        assert_eq!(faults.len(), 1, "{faults:?}");
        let tolerance = ["check", &pair.wrong, "--against", &pair.right, "--tolerance", "0.1mm,0.01deg"];
        let report = congruent_json(&tolerance).json();
        assert_eq!(report["diagnosis"][0]["joint"], "joint_3", "{quarter}");
        assert_eq!(report["diagnosis"][0]["cause"], "joint_origin", "{quarter}");
    }
}

/// Two mistakes in one line are corrected by one line: written one after the other, each would undo the other.
#[test]
fn two_mistakes_of_one_line_are_corrected_together() {
    let scratch = ScratchFolder::new();
    let urdf = fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap();
    let elbow = urdf.find("<joint name=\"elbow_joint\"").unwrap();
    let end = elbow + urdf[elbow..].find("</joint>").unwrap();
    let in_one_line = urdf[elbow..end].replace('\n', " ");
    let right = format!("{}{in_one_line}{}", &urdf[..elbow], &urdf[end..]);
    let wrong = in_one_line
        .replace("-0.425 0 0", "-0.435 0 0")
        .replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0.1 0.99\"/>");
    let wrong = format!("{}{wrong}{}", &urdf[..elbow], &urdf[end..]);
    let (own, other) = (scratch.write("own.urdf", &wrong), scratch.write("other.urdf", &right));
    let answer = congruent_json(&["check", &own, "--against", &other]).json();
    let parts = answer["diagnosis"][0]["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 2, "{answer:#}");
    let [first, second] = [0, 1].map(|at| parts[at]["suggestion"].as_str().unwrap());
    assert_eq!(first.trim(), right.lines().find(|line| line.contains("\"elbow_joint\"")).unwrap().trim());
    assert!(second.contains("nothing more"), "{second}");
}
