//! What `congruent calibrate --same-point` prints.

use std::fmt::Write;

use super::{calibrated_robot::written_text, layout::column_width};
use congruent_calibration::same_point::{SamePointReport, SamePointSpread};
use congruent_input::display::{counted, length};

/// What `congruent calibrate --same-point` prints: the corrections with their uncertainty, and the spread of the tool points before and
/// after.
pub fn same_point_text(report: &SamePointReport) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} with {} at one point in each of {}, model {}",
        report.robot,
        counted(report.rows, "configuration"),
        report.tool_frame,
        counted(report.points.len(), "file"),
        report.model
    );
    let _ = writeln!(text, "  {}", report.chain);
    for statement in &report.statements {
        let _ = writeln!(text, "  {statement}");
    }
    corrections(&mut text, report);
    spreads(&mut text, report);
    points(&mut text, report);
    written_text(&mut text, report.written.as_ref(), &report.chain);
    text
}

fn corrections(text: &mut String, report: &SamePointReport) {
    let names = || report.parameters.iter().map(|each| each.name.len());
    let width = column_width(names().chain(report.fixed.iter().map(|each| each.name.len())));
    if !report.parameters.is_empty() {
        let _ = writeln!(text, "\n  {:width$}  {:>23}", "correction", "least squares");
    }
    for each in &report.parameters {
        let (value, unit) = (each.unit.for_people(each.correction), each.unit.name_for_people());
        let deviation = each.unit.for_people(each.standard_deviation);
        let estimate = format!("{value:+.4} ± {deviation:.4} {unit}");
        let mark = if each.significant { "significant" } else { "-" };
        let _ = writeln!(text, "  {:width$}  {estimate:>23}  {mark}", each.name);
    }
    if !report.fixed.is_empty() {
        text.push_str("\n  held at nominal, not identifiable\n");
    }
    for each in &report.fixed {
        let reason = if Some(&each.name) == report.scale_given_by.as_ref() {
            "gives the scale of the other lengths"
        } else {
            &each.reason
        };
        let _ = writeln!(text, "  {:width$}  {reason}", each.name);
    }
}

fn spreads(text: &mut String, report: &SamePointReport) {
    let _ = writeln!(text, "\n  {:24}  {:>10}  {:>10}", "distance from the point", "mean", "largest");
    let mut line = |name: &str, SamePointSpread { mean_m, worst_m }: &SamePointSpread| {
        let _ = writeln!(text, "  {name:24}  {:>10}  {:>10}", length(*mean_m), length(*worst_m));
    };
    line("nominal", &report.nominal);
    line("corrected", &report.corrected);
    if let Some(held_out) = &report.held_out {
        line("corrected, held out", held_out);
    }
}

fn points(text: &mut String, report: &SamePointReport) {
    let width = column_width(report.points.iter().map(|each| each.file.len())).max("file".len());
    let _ = writeln!(
        text,
        "\n  {:width$}  {:>4}  {:>10}  {:>10}  {:>10}  point in {}, mm",
        "file", "rows", "nominal", "corrected", "largest", report.chain.base
    );
    for each in &report.points {
        let point = each.point_in_base_m.map(|value| format!("{:.3}", value * 1e3)).join(", ");
        let _ = writeln!(
            text,
            "  {:width$}  {:>4}  {:>10}  {:>10}  {:>10}  {point}  (largest: row {})",
            each.file,
            each.rows,
            length(each.nominal.mean_m),
            length(each.corrected.mean_m),
            length(each.corrected.worst_m),
            each.worst_row
        );
    }
}
