//! `check --against`: what the digits of two files explain is rounding, and what is beyond them is a difference.

use std::{fs, path::PathBuf};

use crate::support::{
    command::{congruent, congruent_json},
    corpus::corpus,
    scratch_folder::ScratchFolder,
};

/// Two URDFs of the UR5e, the second with other texts in place of some of its own in its joints, which follow its links.
fn two_files(folder: &ScratchFolder, changes: &[(&str, &str)]) -> [PathBuf; 2] {
    let robot = PathBuf::from(folder.robot("ur5e", &[]));
    let exact = robot.join("ur5e.urdf");
    let text = fs::read_to_string(&exact).unwrap();
    let (links, joints) = text.split_at(text.find("<joint").unwrap());
    let mut joints = joints.to_owned();
    for (from, to) in changes {
        assert!(joints.contains(from), "{from}");
        joints = joints.replace(from, to);
    }
    let text = links.to_owned() + &joints;
    let other = robot.join("other.urdf");
    fs::write(&other, text).unwrap();
    [exact, other]
}

/// The answer of a check of the two in one direction: its first line and JSON.
#[track_caller]
fn answer(files: [&PathBuf; 2]) -> (String, serde_json::Value) {
    let [file, other] = files.map(|file| file.to_str().unwrap());
    let line = congruent(&["check", file, "--against", other, "-q"]);
    (line.stdout + &line.stderr, congruent_json(&["check", file, "--against", other]).json())
}

const ROUNDED: (&str, &str) = ("1.5707963267948966", "1.5708");

#[test]
fn rounded_quarter_turns_are_the_same_robot() {
    let folder = ScratchFolder::new();
    let [exact, rounded] = two_files(&folder, &[ROUNDED]);
    for files in [[&exact, &rounded], [&rounded, &exact]] {
        let (line, json) = answer(files);
        assert!(line.contains("within the digits written"), "{line}");
        assert_eq!(json["grade"], "same_within_digits", "{line}");
        assert_eq!(json["verdict"], "agree", "{line}");
        assert!(json["allowed_by_digits"]["position_m"].as_f64().unwrap() > 1e-6, "{json}");
        assert_eq!(json["diagnosis"].as_array().map(Vec::len), Some(0), "{line}");
    }
}

/// By hand: the tip is off by the turns of 3.7e-6 rad at levers of up to a metre.
#[test]
fn a_declared_tolerance_decides() {
    let folder = ScratchFolder::new();
    let [exact, rounded] = two_files(&folder, &[ROUNDED]);
    let [file, other] = [&exact, &rounded].map(|file| file.to_str().unwrap());
    let check =
        |tolerance: &str| congruent(&["check", file, "--against", other, "--tolerance", tolerance, "-q"]);
    let tight = check("1nm,1e-9rad");
    assert_eq!(tight.code, 1, "{}", tight.stdout);
    assert!(tight.stdout.contains("by rounding alone"), "{}", tight.stdout);
    assert_eq!(check("0.1mm,0.01deg").code, 0);
}

#[test]
fn one_value_beyond_the_digits_is_the_only_cause() {
    let folder = ScratchFolder::new();
    let [exact, other] =
        two_files(&folder, &[ROUNDED, ("xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.3932 0 0.1333\"")]);
    let (line, json) = answer([&exact, &other]);
    assert!(line.contains("DIFFERENT") && line.contains("Cause: joint \"wrist_1_joint\""), "{line}");
    assert_eq!(json["grade"], "different");
}

/// Two files that round a length to the same place write the same number.
#[test]
fn another_last_place_is_a_difference() {
    let folder = ScratchFolder::new();
    let [exact, other] = two_files(&folder, &[("xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.3923 0 0.1333\"")]);
    let (line, json) = answer([&exact, &other]);
    assert_eq!(json["grade"], "different", "{line}");
    assert!(line.contains("wrist_1_joint"), "{line}");
}

/// A finer file beside a coarse one: the coarse length allows half a place, and no more.
#[test]
fn a_finer_length_is_within_half_a_place_of_the_coarse_one() {
    let from = "xyz=\"-0.3922 0 0.1333\"";
    for (finer, expected) in [("-0.39224", "same_within_digits"), ("-0.39231", "different")] {
        let folder = ScratchFolder::new();
        let [exact, other] = two_files(&folder, &[(from, &format!("xyz=\"{finer} 0 0.1333\""))]);
        for files in [[&exact, &other], [&other, &exact]] {
            let (line, json) = answer(files);
            assert_eq!(json["grade"], expected, "{finer}: {line}");
        }
    }
}

/// Rounded masses, inertial frames, moments and limits are no difference; one that is off by more is the only one named.
#[test]
fn masses_inertias_and_limits_are_rounded_values_too() {
    let rounded = [
        ("<mass value=\"8.058\"/>", "<mass value=\"8.06\"/>"),
        (
            "xyz=\"-0.2125 0 0.11336\" rpy=\"0 1.5707963267948966 0\"",
            "xyz=\"-0.2125 0 0.1134\" rpy=\"0 1.5708 0\"",
        ),
        ("ixx=\"0.13388583541666665\"", "ixx=\"0.1339\""),
        ("upper=\"6.283185307179586\"", "upper=\"6.283\""),
    ];
    let folder = ScratchFolder::new();
    let robot = PathBuf::from(folder.robot("ur5e", &[]));
    let exact = robot.join("ur5e.urdf");
    let text = fs::read_to_string(&exact).unwrap();
    let with = |changes: &[(&str, &str)]| {
        changes.iter().fold(text.clone(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replace(from, to)
        })
    };
    let other = robot.join("other.urdf");
    fs::write(&other, with(&rounded)).unwrap();
    for files in [[&exact, &other], [&other, &exact]] {
        let (line, json) = answer(files);
        assert!(line.contains("SAME ROBOT within the digits written"), "{line}");
        assert_eq!([&json["grade"], &json["verdict"]], ["same_within_digits", "agree"], "{line}");
        let values: Vec<&str> = json["against"]["values_within_digits"]
            .as_array()
            .unwrap()
            .iter()
            .map(|value| value.as_str().unwrap())
            .collect();
        for value in ["mass", "centre of mass", "inertia"] {
            assert!(values.contains(&&*format!("upper_arm_link: {value}")), "{values:?}");
        }
        assert!(values.iter().any(|value| value.ends_with(": upper")), "{values:?}");
    }
    let heavier = [("<mass value=\"2.846\"/>", "<mass value=\"2.946\"/>")];
    fs::write(&other, with(&[&rounded[..], &heavier[..]].concat())).unwrap();
    let (line, json) = answer([&exact, &other]);
    assert!(
        line.contains("DIFFERENT DYNAMICS: forearm_link: mass 2.846 kg") && !line.contains(" more"),
        "{line}"
    );
    assert_eq!(json["dynamics"]["limits"].as_array().map(Vec::len), Some(0), "{line}");
}

/// Three decimals of angles and lengths of a public arm, of which several are in the middle between two.
#[test]
fn middles_between_two_last_places_are_rounded_together() {
    let Some(corpus) = corpus() else { return };
    let exact = corpus.join("pairs/urdf-jaco-kinova-drake/b.urdf");
    let text = fs::read_to_string(&exact).unwrap();
    let (links, joints) = text.split_at(text.find("<joint").unwrap());
    let rounded = |number: &str| match number.parse::<f64>() {
        Ok(value) => format!("{value:.3}"),
        Err(_) => number.to_owned(),
    };
    let mut other = links.to_owned();
    for (at, part) in joints.split('"').enumerate() {
        let numbers: Vec<&str> = part.split_whitespace().collect();
        let is_triple =
            at % 2 == 1 && numbers.len() == 3 && numbers.iter().all(|of| of.parse::<f64>().is_ok());
        let quote = if at == 0 { "" } else { "\"" };
        let part = if is_triple {
            numbers.iter().map(|of| rounded(of)).collect::<Vec<_>>().join(" ")
        } else {
            part.to_owned()
        };
        other += quote;
        other += &part;
    }
    let folder = ScratchFolder::new();
    let other = PathBuf::from(folder.write("rounded.urdf", &other));
    for files in [[&exact, &other], [&other, &exact]] {
        let (line, json) = answer(files);
        assert_eq!(json["grade"], "same_within_digits", "{line}");
    }
}

/// One wrong sign beside rounded angles is one cause, although other directions and zeros of joints put all axes alike, too.
#[test]
fn a_wrong_sign_is_no_other_variable() {
    let folder = ScratchFolder::new();
    let robot = PathBuf::from(folder.robot("panda", &[]));
    let exact = robot.join("panda.urdf");
    let text = fs::read_to_string(&exact).unwrap();
    let wrong =
        text.replace("1.5707963267948966", "1.5708").replace("xyz=\"0.088 0 0\"", "xyz=\"-0.088 0 0\"");
    assert_ne!(wrong.matches("-0.088").count(), 0);
    let other = robot.join("other.urdf");
    fs::write(&other, wrong).unwrap();
    let (line, json) = answer([&exact, &other]);
    assert!(line.contains("Cause: joint \"panda_joint7\": origin"), "{line}");
    assert!(json["against"]["mapping"].is_null(), "{line}");
}

/// Of the public UR5e pair one file has whole millimetres, and its base is turned by half a turn. The lines that the answer asks for
/// make the geometry equal, and so does a fitted base.
#[test]
fn what_the_answer_asks_to_declare_makes_the_geometry_equal() {
    let Some(corpus) = corpus() else { return };
    let pair = corpus.join("pairs/ur5e");
    let [file, other] = ["robot.xml", "partner.urdf"].map(|name| pair.join(name));
    let (line, json) = answer([&file, &other]);
    assert!(
        line.contains("SAME GEOMETRY AFTER MAPPING, DIFFERENT DYNAMICS: the base is turned by 180 deg"),
        "{line}"
    );
    let lines = json["against"]["mapping"]["lines"].as_array().unwrap();
    let lines: Vec<&str> = lines.iter().map(|line| line.as_str().unwrap()).collect();
    for mapping in [lines.join("\n"), "tip = \"wrist_3_link\"\n[mapping]\nbase = \"fitted\"".to_owned()] {
        let folder = ScratchFolder::new();
        let text = format!("description = {file:?}\n{mapping}\n");
        let robot = PathBuf::from(folder.write("robot.toml", &text));
        let (line, json) = answer([&robot, &other]);
        assert!(line.contains("SAME GEOMETRY, DIFFERENT DYNAMICS"), "{mapping}: {line}");
        assert_eq!(json["diagnosis"].as_array().map(Vec::len), Some(0), "{mapping}: {line}");
    }
}

/// Another direction of a joint beside lengths in whole millimetres, which some of the robot's own are not.
#[test]
fn another_direction_beside_rounded_lengths_is_a_mapping() {
    let folder = ScratchFolder::new();
    let robot = PathBuf::from(folder.robot("ur5e", &[]));
    let exact = robot.join("ur5e.urdf");
    let text = fs::read_to_string(&exact).unwrap();
    let at = text.find("<joint name=\"elbow_joint\"").unwrap();
    let (before, joint) = text.split_at(at);
    let flipped = joint.replacen("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 -1\"/>", 1);
    assert_ne!(flipped, joint);
    let rounded =
        (before.to_owned() + &flipped).replace("xyz=\"-0.3922 0 0.1333\"", "xyz=\"-0.392 0 0.133\"");
    let other = robot.join("other.urdf");
    fs::write(&other, rounded).unwrap();
    let (line, json) = answer([&exact, &other]);
    assert!(line.contains("EQUAL AFTER MAPPING: elbow_joint has the opposite direction"), "{line}");
    assert_eq!(json["against"]["mapping"]["verdict"], "agree", "{line}");
}

/// 0.4 g at a point of the second axis count to the first link or to the second: no torque differs. Masses and centres are within
/// their digits of each other, products of inertia of 0 are not.
#[test]
fn masses_that_are_split_otherwise_are_equal_although_a_part_of_them_is_within_the_digits() {
    let link = |name: &str, mass: &str, com: &str, tensor: [&str; 6]| {
        let [xx, yy, zz, xy, xz, yz] = tensor;
        format!(
            "<link name=\"{name}\"><inertial><origin xyz=\"{com}\"/><mass value=\"{mass}\"/><inertia ixx=\"{xx}\" iyy=\"{yy}\" \
             izz=\"{zz}\" ixy=\"{xy}\" ixz=\"{xz}\" iyz=\"{yz}\"/></inertial></link>\n"
        )
    };
    let joint = |name: &str, links: [&str; 2], placed: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/>{placed}\
             <limit lower=\"-2\" upper=\"2\" effort=\"9\" velocity=\"3\"/></joint>\n",
            links[0], links[1]
        )
    };
    let joints = joint("j1", ["base", "upper"], "<axis xyz=\"0 1 0\"/>")
        + &joint("j2", ["upper", "lower"], "<origin xyz=\"0.4 0 0\"/><axis xyz=\"1 0 0\"/>");
    let robot = |links: [String; 2]| {
        format!("<robot name=\"two\"><link name=\"base\"/>\n{}{joints}</robot>\n", links.concat())
    };
    let typed = ["0.02", "0.03", "0.04", "0", "0", "0"];
    let own =
        robot([link("upper", "3.000", "0.2 0 0", typed), link("lower", "2.000", "0.1 0.05 0.02", typed)]);
    let upper = ["0.02", "0.030099986668444212", "0.040099986668444221", "0", "0", "0"];
    let lower = [
        "0.019998839767953591",
        "0.029983836767353465",
        "0.039982996599319871",
        "-4.0008001600342485e-06",
        "-1.6003200640126586e-06",
        "4.0008001600316465e-07",
    ];
    let other = robot([
        link("upper", "3.0004", "0.20006665777896282 0 0", upper),
        link("lower", "1.9996", "0.09995999199839968 0.050010002000400081 0.020004000800160033", lower),
    ]);
    let scratch = ScratchFolder::new();
    let files = [scratch.write("own.urdf", &own), scratch.write("other.urdf", &other)];
    for [one, two] in [[0, 1], [1, 0]] {
        let answer = congruent(&["check", &files[one], "--against", &files[two], "-q"]);
        assert!(answer.code == 0 && answer.stdout.contains(": SAME ROBOT."), "{}", answer.stdout);
    }
}
