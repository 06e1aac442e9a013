//! A robot of `robots/` checked after changes to its file, and the first cause that the check names.

use std::fs;

use serde_json::Value;

use super::{
    command::{Answer, congruent_json, text},
    corpus::workspace,
};

/// A fitted value: rounding of the fit, some hundred operations on numbers up to 10; worst 2e-12
/// against a URDF that writes pi/2 with ten digits.
pub(crate) const FITTED: f64 = 1e-9;

/// Within the row of a joint, or anywhere for an empty name, the first text becomes the second.
pub(crate) type Change<'a> = (&'a str, &'a str, &'a str);

/// Checks a robot of `robots/` after changes to its file.
#[track_caller]
pub(crate) fn check_changed(robot: &str, changes: &[Change<'_>]) -> (Answer, String) {
    let folder = workspace().join("robots").join(robot);
    let mut file = fs::read_to_string(folder.join("robot.toml")).unwrap();
    for &(joint, from, to) in changes {
        let start = if joint.is_empty() { 0 } else { file.find(&format!("joint = \"{joint}\"")).unwrap() };
        let at = start + file[start..].find(from).unwrap_or_else(|| panic!("no {from} behind {joint}"));
        file.replace_range(at..at + from.len(), to);
    }
    let name = format!("{robot}.urdf");
    file = file.replacen(&format!("{name:?}"), &format!("{:?}", text(&folder.join(&name))), 1);
    let srdf = format!("srdf = \"{robot}.srdf\"\n");
    file = file.replacen(&srdf, "", 1);
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path().join("robot.toml");
    fs::write(&path, &file).unwrap();
    (congruent_json(&["check", &text(&path)]), file)
}

/// The first cause of a disagreement.
#[track_caller]
pub(crate) fn first_cause(answer: &Answer) -> Value {
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    let report = answer.json();
    assert_eq!(report["verdict"], "disagree");
    report["diagnosis"][0].clone()
}

/// A fitted value within the accuracy of the fit.
#[track_caller]
pub(crate) fn near(found: &Value, expected: f64) {
    let number = found.as_f64().unwrap_or_else(|| panic!("no number: {found}"));
    assert!((number - expected).abs() < FITTED, "{number} not {expected}");
}

/// The line at fault, as an editor counts.
#[track_caller]
pub(crate) fn is_at_line(cause: &Value, file: &str, line: &str) {
    let number = usize::try_from(cause["line"].as_u64().expect("a line")).unwrap();
    assert_eq!(file.lines().nth(number - 1), Some(line));
}
