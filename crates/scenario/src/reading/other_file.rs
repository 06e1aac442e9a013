//! Files and folders that people give in the place of a scenario, and what they meant.

use std::path::Path;

use congruent_input::{Diagnostic, TomlKind, codes::file::DIRECTORY};

use crate::codes;

/// Refuses a folder: that of a robot, or one with scenarios in it.
pub(super) fn refuse_folder(path: &Path) -> Result<(), Diagnostic> {
    if !path.is_dir() {
        return Ok(());
    }
    if path.join("robot.toml").is_file() {
        return Err(robot_given(path));
    }
    let mut files = std::fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path());
    let help = if files.any(|file| file.extension().is_some_and(|ending| ending == "toml")) {
        format!("for the scenarios in it: congruent run {}", path.join("*.toml").display())
    } else {
        "give the name of a file in it".to_owned()
    };
    Err(Diagnostic::error(DIRECTORY, format!("{} is a directory, not a file", path.display()))
        .with_help(help))
}

/// Refuses a page of results, the plan of a sweep, and a robot.
pub(super) fn refuse_other_text(path: &Path, text: &str) -> Result<(), Diagnostic> {
    let begin = text.trim_start();
    let is_page = begin.get(..9).is_some_and(|head| head.eq_ignore_ascii_case("<!doctype"));
    if is_page {
        let message = format!("{} is a web page, not a scenario", path.display());
        let help = "a page of results is for the browser; the scenario of its run is scenario.resolved.toml beside it";
        return Err(Diagnostic::error(codes::scenario::ROBOT_GIVEN, message).with_help(help));
    }
    if text.lines().any(|line| line.trim_start().starts_with("[[vary]]")) {
        let path = path.display();
        let message = format!("{path} is the plan of a sweep, not a scenario");
        let help = format!("to run its cases: congruent sweep run {path} --out DIR");
        return Err(Diagnostic::error(codes::scenario::ROBOT_GIVEN, message).with_help(help));
    }
    let is_robot = begin.starts_with('<') || TomlKind::from_text(text) == Some(TomlKind::RobotFile);
    if is_robot { Err(robot_given(path)) } else { Ok(()) }
}

fn robot_given(path: &Path) -> Diagnostic {
    let path = path.display();
    Diagnostic::error(codes::scenario::ROBOT_GIVEN, format!("{path} is a robot, not a scenario"))
        .with_help(format!("to check it: congruent check {path}; for a scenario of it: congruent new scenario {path} --to FILE.toml"))
}
