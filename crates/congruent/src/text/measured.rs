//! What `congruent check --measurements` prints.

use std::fmt::Write;

use congruent_calibration::{FittedCorrection, MeasuredCheck, MeasuredDifference, MeasuredVerdict};
use congruent_description::Robot;
use congruent_input::display::length_and_angle;
use congruent_text::{
    camera_text,
    layout::{column_width, wrapped},
};

use crate::check::{fitted_frames, measured_headline};

/// Most rows that are listed.
const MOST_ROWS: usize = 8;

/// What `congruent check --measurements` prints: the answer, the worst row with its joint positions, the fitted frames, and the rows that
/// are furthest off.
pub fn measured_text(check: &MeasuredCheck, robot: &Robot) -> String {
    let mut text =
        format!("{}: {}\n  {}: {}\n", check.file, measured_headline(check), check.robot, check.chain);
    let _ = writeln!(text, "  the worst, measurement {} (line {}), is at", check.worst.row, check.worst.line);
    text += &wrapped(&check.worst_q.for_people(robot));
    fitted(&mut text, check);
    if check.verdict == MeasuredVerdict::Disagree {
        beyond(&mut text, check);
        let free = match &check.camera {
            Some(camera) => format!(" --camera {}", camera.mount),
            None if check.fitted.is_empty() => String::new(),
            None => format!(",{}", fitted_frames(check).join(",")),
        };
        let _ = writeln!(
            text,
            "  what would have to change: congruent calibrate {} {} --free zero-offsets{free}",
            check.file, check.measurements
        );
    }
    text
}

fn fitted(text: &mut String, check: &MeasuredCheck) {
    if check.fitted.is_empty() {
        return;
    }
    if let Some(camera) = &check.camera {
        camera_text(text, camera, "fitted before the comparison, and not compared");
        return;
    }
    let _ = writeln!(text, "\n  fitted before the comparison, and not compared");
    let width = column_width(check.fitted.iter().map(|each| each.name.len()));
    for FittedCorrection { name, unit, value, is_identified } in &check.fitted {
        let held = if *is_identified { "" } else { "  held: these measurements do not identify it" };
        let _ = writeln!(
            text,
            "  {name:width$}  {:>+12.4} {}{held}",
            unit.for_people(*value),
            unit.name_for_people()
        );
    }
}

fn beyond(text: &mut String, check: &MeasuredCheck) {
    let mut rows: Vec<&MeasuredDifference> =
        check.row_differences.iter().filter(|row| row.is_beyond).collect();
    rows.sort_by(|a, b| b.excess.total_cmp(&a.excess));
    let _ = writeln!(text, "\n  beyond the tolerance, the farthest first");
    for row in rows.iter().take(MOST_ROWS) {
        let _ = writeln!(
            text,
            "  measurement {:4} (line {})  {:>26}",
            row.row,
            row.line,
            length_and_angle(row.position_m, row.orientation_rad)
        );
    }
    if rows.len() > MOST_ROWS {
        let _ = writeln!(text, "  and {} more", rows.len() - MOST_ROWS);
    }
}
