//! `congruent check` of two descriptions whose joints count otherwise: the ranges that both files write show whether a direction or a zero is
//! meant, and what is printed to be declared makes the two agree.

use std::fs;

use regex_lite::Regex;

use crate::support::{
    command::congruent,
    corpus::{corpus, workspace},
    scratch_folder::ScratchFolder,
};

const ELBOW: &str = "<joint name=\"elbow_joint\" type=\"revolute\">\n    <origin xyz=\"-0.425 0 0\"/>";

fn ur5e() -> String {
    let urdf = fs::read_to_string(workspace().join("robots/ur5e/ur5e.urdf")).unwrap();
    assert!(urdf.contains(ELBOW));
    urdf
}

/// The first line for a UR5e with other text at its elbow, against the original, and the other way round.
fn both_ways(elbow: &str, more: [&str; 2]) -> [String; 2] {
    let scratch = ScratchFolder::new();
    let own = scratch.write("own.urdf", &ur5e().replace(ELBOW, elbow).replace(more[0], more[1]));
    let original = scratch.write("ur5e.urdf", &ur5e());
    [[&own, &original], [&original, &own]]
        .map(|[one, other]| congruent(&["check", "-q", one, "--against", other]).stdout)
}

/// Another zero would need another range: the origin is wrong.
#[test]
fn an_origin_that_is_turned_about_its_axis_is_the_cause_if_the_range_is_the_same() {
    let turned = ELBOW.replace("/>", " rpy=\"0 0 0.5\"/>");
    for line in both_ways(&turned, ["", ""]) {
        assert!(line.contains("Cause: joint \"elbow_joint\": origin"), "{line}");
        assert!(!line.contains("another zero") && !line.contains("limits differ"), "{line}");
    }
}

/// A zero with the range that belongs to it is a convention.
#[test]
fn a_zero_that_explains_the_range_is_a_mapping() {
    let turned = ELBOW.replace("/>", " rpy=\"0 0 0.5\"/>");
    let elbow = ur5e();
    let elbow = &elbow[elbow.find(ELBOW).unwrap()..];
    let limit = &elbow[elbow.find("<limit").unwrap()..];
    let limit = &limit[..=limit.find('>').unwrap()];
    let pi = std::f64::consts::PI;
    let moved = limit
        .replace("lower=\"-3.141592653589793\"", &format!("lower=\"{}\"", -pi - 0.5))
        .replace("upper=\"3.141592653589793\"", &format!("upper=\"{}\"", pi - 0.5));
    assert_ne!(limit, moved);
    for line in both_ways(&turned, [limit, &moved]) {
        assert!(line.contains("EQUAL AFTER MAPPING: elbow_joint has another zero ("), "{line}");
    }
}

/// A joint of the arm that one of the two files fixes makes another chain, in both orders of the files. Nobody has declared it, so that
/// the rest is compared with it at 0.
#[test]
fn a_fixed_joint_of_the_arm_is_another_chain_in_both_orders() {
    let lines = both_ways(&ELBOW.replace("revolute", "fixed"), ["", ""]);
    for line in lines {
        let answer = "DIFFERENT JOINTS: elbow_joint moves in ur5e.urdf alone, between base and tip; with elbow_joint at 0, poses agree";
        assert!(line.contains(answer), "{line}");
    }
    let scratch = ScratchFolder::new();
    scratch.write("fixed.urdf", &ur5e().replace(ELBOW, &ELBOW.replace("revolute", "fixed")));
    let declared =
        scratch.write("fixed.toml", "urdf = \"fixed.urdf\"\n[mapping]\nleft_out = [\"elbow_joint\"]\n");
    let answer = congruent(&["check", "-q", &declared, "--against", "robots/ur5e/ur5e.urdf"]);
    let (code, line) = (answer.code, answer.stdout);
    assert!(
        code == 0
            && line.contains("SAME ROBOT in 5 of 6 joints (those of both files, with elbow_joint at 0)"),
        "{line}"
    );
}

/// Behind a joint that moves in both files and is left out, nothing is compared, and nothing counts as compared.
#[test]
fn joints_behind_one_that_is_left_out_are_not_counted() {
    let scratch = ScratchFolder::new();
    scratch.write("own.urdf", &ur5e());
    let declared =
        scratch.write("own.toml", "urdf = \"own.urdf\"\n[mapping]\nleft_out = [\"elbow_joint\"]\n");
    let other = scratch.write("other.urdf", &ur5e().replace("0 -0.0997 0", "0 -0.0997 0.02"));
    let answer = congruent(&["check", "-q", &declared, "--against", &other]).stdout;
    assert!(
        answer.contains("SAME ROBOT in 2 of 6 joints (none behind elbow_joint, left out by [mapping])"),
        "{answer}"
    );
}

/// A flip of a joint with a one-sided range, which both files write, is a wrong axis and no exchanged range.
#[test]
fn a_flipped_axis_with_the_same_one_sided_range_is_the_cause() {
    let urdf = ur5e().replace("lower=\"-3.141592653589793\"", "lower=\"0\"");
    let elbow = urdf.find(ELBOW).unwrap();
    let (before, behind) = urdf.split_at(elbow);
    let flipped = [before, &behind.replacen("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 -1\"/>", 1)].concat();
    let scratch = ScratchFolder::new();
    let [own, other] =
        [("own.urdf", &flipped), ("ur5e.urdf", &urdf)].map(|(name, text)| scratch.write(name, text));
    let line = congruent(&["check", "-q", &own, "--against", &other]).stdout;
    assert!(line.contains("Cause: joint \"elbow_joint\" moves in the opposite direction"), "{line}");
    assert!(!line.contains("exchanged") && !line.contains("limits differ"), "{line}");
}

/// Declared as printed, the mapping of a public pair gives the geometry that it had when it was found: its zeros are sums of angles with five
/// decimals, as 3.37079 and 3.14158.
#[test]
fn a_mapping_that_is_declared_as_printed_agrees_within_the_digits() {
    let Some(folder) = corpus().map(|corpus| corpus.join("pairs/so_arm100")) else { return };
    let [mjcf, urdf] = ["robot.xml", "partner.urdf"].map(|file| folder.join(file).display().to_string());
    let scratch = ScratchFolder::new();
    for [own, other] in [[&mjcf, &urdf], [&urdf, &mjcf]] {
        let printed = congruent(&["check", own, "--against", other]).stdout;
        let section = Regex::new(r"declare it in robot\.toml:\n\n((?: {6}.*\n)+)").unwrap();
        let lines = &section.captures(&printed).unwrap_or_else(|| panic!("{printed}"))[1];
        let robot =
            scratch.write("robot.toml", &format!("description = {own:?}\n{}", lines.replace("      ", "")));
        let line = congruent(&["check", "-q", &robot, "--against", other]).stdout;
        assert!(line.contains(": SAME GEOMETRY, DIFFERENT DYNAMICS: "), "{line}");
    }
}
