//! What `congruent new robot` and `congruent new scenario` print.

use std::fmt::Write;

use congruent_agreement::compare::Agreement;
use congruent_input::display::length_and_angle;
use congruent_results::report::lines;
use congruent_starter::{NewRobot, NewScenario};

use crate::layout::paragraph;

/// What `congruent new robot` prints: the file, its chain and table, and the result of its check.
pub fn new_robot_text(report: &NewRobot) -> String {
    let mut text = format!("written to {}\n", report.file);
    text += &paragraph(&report.chain.to_string(), 2, 4);
    text += &paragraph(&format!("refers to {}; nothing is copied", report.urdf), 2, 4);
    if let Some(why) = &report.no_table {
        text += &paragraph(&format!("without a table: {why}"), 2, 4);
    }
    let worst = length_and_angle(report.worst.error.position_m, report.worst.error.orientation_rad);
    let tolerance = length_and_angle(report.tolerance.position_m, report.tolerance.orientation_rad);
    let _ = match report.verdict {
        Agreement::NothingCompared => {
            writeln!(text, "  check: nothing to compare: {}", Agreement::why_nothing(&report.chain))
        }
        verdict => writeln!(text, "  check: {verdict}, largest difference {worst} (tolerance {tolerance})"),
    };
    text
}

/// What `congruent new scenario` prints: the file, what moves, what was left out, and the result of each check.
pub fn new_scenario_text(report: &NewScenario) -> String {
    let mut text = format!("written to {}, which passes\n", report.file);
    text += &paragraph(&report.chain.to_string(), 2, 4);
    let joints = report.joints.join(", ");
    let (seconds, controller) = (report.duration_s, &report.controller);
    let line = format!("there and back in {seconds:.1} s, controller {controller}: {joints}");
    text += &paragraph(&line, 2, 4);
    for remark in &report.remarks {
        text += &paragraph(remark, 2, 4);
    }
    for check in &report.checks {
        let words = lines(check);
        let worst = words.first().map_or(String::new(), |line| format!(": {line}"));
        text += &paragraph(&format!("{} {}{worst}", check.status.word(), check.check), 2, 4);
    }
    text
}
