//! The corrected table at the end of a check, and `--fix`, which writes it and checks it again.

use std::{fs, path::Path};

use tempfile::TempDir;

use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
};

/// The small arm of the guide with its table changed.
fn arm(change: impl Fn(&str) -> String) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let example = workspace().join("docs/examples/arm");
    fs::copy(example.join("arm.urdf"), folder.path().join("arm.urdf")).unwrap();
    let file = fs::read_to_string(example.join("robot.toml")).unwrap();
    fs::write(folder.path().join("robot.toml"), change(&file)).unwrap();
    folder
}

fn replaced(from: &'static str, to: &'static str) -> impl Fn(&str) -> String {
    move |file| {
        assert!(file.contains(from), "no {from}");
        file.replacen(from, to, 1)
    }
}

fn file(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn a_check_ends_with_the_whole_table_corrected() {
    let right = file(&workspace().join("docs/examples/arm"), "robot.toml");
    let folder = arm(replaced("a_m = 0.35", "a_m = 0.53"));
    let answer = congruent(&["check", &text(folder.path())]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    assert!(answer.stdout.contains("(two digits are transposed)"), "{}", answer.stdout);
    let (_, table) = answer.stdout.split_once("robot.toml, corrected:\n\n").expect("a table");
    let section = &right[right.find("[dh]").unwrap()..];
    assert_eq!(table.trim_end(), section.trim_end(), "the right file has nothing behind its table");
    let report = congruent_json(&["check", &text(folder.path())]).json();
    assert_eq!(report["diagnoses"][0]["corrected"]["text"], right);
    assert!(report.get("fix").is_none());
    assert!(!folder.path().join("robot.fixed.toml").exists());
}

#[test]
fn fix_writes_the_corrected_file_and_answers_for_it() {
    let right = file(&workspace().join("docs/examples/arm"), "robot.toml");
    let folder = arm(replaced("a_m = 0.35", "a_m = 0.53"));
    for _ in 0..2 {
        // The second time it replaces its own file.
        let answer = congruent(&["check", &text(folder.path()), "--fix"]);
        assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
        assert!(answer.stdout.contains("robot.fixed.toml\n  checked again: SAME "), "{}", answer.stdout);
        let fixed = file(folder.path(), "robot.fixed.toml");
        let (first, rest) = fixed.split_once('\n').unwrap();
        assert!(first.starts_with("# Written by congruent check --fix from robot.toml"), "{first}");
        assert_eq!(rest, right);
        assert!(file(folder.path(), "robot.toml").contains("a_m = 0.53"), "the file itself is kept");
    }
    let quiet = congruent(&["check", &text(folder.path()), "--fix", "-q"]).stdout;
    let lines: Vec<&str> = quiet.lines().collect();
    assert!(lines[0].contains("robot.toml: DIFFERENT") && lines[0].contains("0.53"), "{quiet}");
    assert!(lines.len() == 2 && lines[1].contains("robot.fixed.toml: SAME "), "{quiet}");
    let report = congruent_json(&["check", &text(folder.path()), "--fix"]);
    assert_eq!(report.code, 0);
    let report = report.json();
    assert_eq!([&report["verdict"], &report["fix"]["verdict"]], ["disagree", "agree"]);
}

#[test]
fn fix_keeps_a_file_of_somebody_else() {
    let folder = arm(replaced("a_m = 0.35", "a_m = 0.53"));
    fs::write(folder.path().join("robot.fixed.toml"), "name = \"mine\"\n").unwrap();
    let answer = congruent(&["check", &text(folder.path()), "--fix"]);
    assert_eq!(answer.code, 1, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("exists and is not of --fix"), "{}", answer.stdout);
    assert_eq!(file(folder.path(), "robot.fixed.toml"), "name = \"mine\"\n");
}

#[test]
fn a_dropped_joint_is_written_into_the_table() {
    let folder = arm(|file| {
        let lines = file.lines().filter(|line| !line.starts_with("base_from_dh0"));
        lines.collect::<Vec<_>>().join("\n")
    });
    let answer = congruent(&["check", &text(folder.path()), "--fix"]);
    assert_eq!(answer.code, 0, "{}{}", answer.stdout, answer.stderr);
    assert!(answer.stdout.contains("check::fixed_joint_dropped"), "{}", answer.stdout);
    assert!(file(folder.path(), "robot.fixed.toml").contains("base_from_dh0 = "));
}

#[test]
fn nothing_is_written_if_there_is_nothing_to_correct() {
    let nothing = |folder: &TempDir, code: i32, why: &str| {
        let answer = congruent(&["check", &text(folder.path()), "--fix"]);
        assert_eq!(answer.code, code, "{}{}", answer.stdout, answer.stderr);
        assert!(answer.stdout.contains(&format!("nothing written: {why}")), "{}", answer.stdout);
        assert!(!folder.path().join("robot.fixed.toml").exists());
    };
    nothing(&arm(str::to_owned), 0, "no difference is to be corrected");
    // Every length and several angles are wrong: no cause is found.
    let unknown = |file: &str| {
        let changes = [
            ("= 0.35", "= 0.31"),
            ("0.05", "0.07"),
            ("90", "80"),
            ("= 0.3\n", "= 0.37\n"),
            ("0.28", "0.33"),
            ("0.025", "0.04"),
            ("0.06", "0.09"),
            ("20, -35", "23, 35"),
            ("0, 0, 30", "10, 20, 30"),
            ("alpha_deg = 0.0", "alpha_deg = 30"),
            ("theta_deg = 0.0", "theta_deg = 40"),
        ];
        changes.iter().fold(file.to_owned(), |file, (from, to)| file.replace(from, to))
    };
    nothing(&arm(unknown), 1, "no known cause explains the difference");
}
