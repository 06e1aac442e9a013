//! The diagnosis of `congruent check` as text for people: what is wrong, the lines to paste, the difference before
//! and after each correction; and the table row by row if that is not all.

use std::fmt::Write;

use crate::{
    agreement::{
        compare::CheckReport,
        diagnosis::{Cause, Invariant},
        report::{
            ComparedValue, Fault, ReportedAlternative, ReportedCause, ReportedDiagnosis, ReportedDifference,
            ReportedStage, TableComparison,
        },
    },
    description::Tolerance,
    input::{
        Diagnostic,
        display::{angle, length, length_and_angle, number},
    },
    kinematics::PoseError,
};

use congruent_text::{TextOptions, finding_text, layout::column_width};

/// The first cause with its lines of the file, then the causes that cannot be distinguished from it and the
/// next best ones.
pub(super) fn diagnosed(
    text: &mut String,
    diagnosis: &ReportedDiagnosis,
    tolerance: &Tolerance,
    options: &TextOptions,
) {
    /// Alternatives shown to people; JSON has all of them.
    const SHOWN: usize = 6;
    /// Next best causes are shown if their residual is at most so many times that of the first, or the tolerance.
    const AS_GOOD: f64 = 10.0;
    let Some(first) = diagnosis.causes.first() else { return };
    let faults: Vec<&Fault> = first.faults().iter().collect();
    let _ =
        writeln!(text, "\n  {}: {}", diagnosis.title, summary(first, diagnosis.findings.len(), tolerance));
    for (at, (finding, fault)) in diagnosis.findings.iter().zip(&faults).enumerate() {
        text.push_str(&finding_text(&Diagnostic { help: None, ..finding.clone() }, options));
        found(text, fault, first.stages.get(at));
    }
    if diagnosis.findings.is_empty() {
        diagnosis.invariants.iter().for_each(|difference| differs(text, difference));
    }
    // Only where a person could choose: what asks for more lines, or for the same ones, is no alternative.
    let lines = |faults: &[Fault]| faults.iter().map(|fault| fault.pasted.len()).sum::<usize>();
    let most = lines(first.faults());
    // An exchange of two values is one mistake in two lines.
    let changes = |fault: &Fault| match fault.cause {
        Cause::ParametersExchanged if fault.pasted.len() == 2 => 1,
        _ => fault.pasted.len(),
    };
    let can_be_chosen = |other: &&ReportedAlternative| {
        let other = other.cause.faults();
        other.iter().map(changes).sum::<usize>() <= most
            && other.iter().any(|fault| !is_pasted(fault, &faults))
    };
    let choices: Vec<&ReportedAlternative> =
        diagnosis.indistinguishable.iter().filter(can_be_chosen).collect();
    for alternative in choices.iter().take(SHOWN) {
        equivalent(text, alternative, &faults);
    }
    if let Some(more) = choices.len().checked_sub(SHOWN + 1) {
        let _ = writeln!(text, "  and {} more causes that cannot be distinguished", more + 1);
    }
    let found_error =
        first.stages.first().map_or(
            PoseError { position_m: first.residual_m, orientation_rad: first.residual_rad },
            |stage| stage.before,
        );
    let is_as_good = |next: &&ReportedCause| {
        // A correction that makes the difference larger is none.
        next.residual_m <= found_error.position_m
            && next.residual_rad <= found_error.orientation_rad
            && next.residual_m <= AS_GOOD * first.residual_m.max(tolerance.position_m)
            && next.residual_rad <= AS_GOOD * first.residual_rad.max(tolerance.orientation_rad)
    };
    let mut next: Vec<&ReportedCause> = diagnosis.causes[1..].iter().filter(is_as_good).collect();
    next.sort_by(|one, other| one.residual_m.total_cmp(&other.residual_m));
    for next in next {
        let _ = writeln!(text, "  next best: {}; residual {}", next.fault.message, residual(next));
    }
    if let Some(table) = &diagnosis.table {
        row_by_row(text, table);
    }
}

/// What to do if the digits explain all of a difference that the tolerance does not allow.
pub(super) fn rounded(text: &mut String, report: &CheckReport) {
    let _ = writeln!(
        text,
        "  rounding explains the difference: declare a tolerance that the digits allow, or write more digits"
    );
    if let Some(table) = report.diagnoses.iter().find_map(|diagnosis| diagnosis.table.as_ref()) {
        row_by_row(text, table);
    }
}

fn residual(cause: &ReportedCause) -> String {
    length_and_angle(cause.residual_m, cause.residual_rad)
}

/// How much of the difference is explained.
fn summary(cause: &ReportedCause, count: usize, tolerance: &Tolerance) -> String {
    let corrections = match count {
        0 => return "no known cause explains the difference".to_owned(),
        1 => "after one correction".to_owned(),
        _ => format!("after {count} corrections, the one with the largest effect first,"),
    };
    let residual_error = PoseError { position_m: cause.residual_m, orientation_rad: cause.residual_rad };
    let residual = residual(cause);
    if cause.within_tolerance && !residual_error.is_within(tolerance) {
        // The check of the corrected file has other configurations, the worst of its own certificates among them.
        format!("{corrections} poses differ by {residual} in this check, which the digits allow")
    } else if cause.within_tolerance {
        format!("{corrections} poses differ by {residual}")
    } else {
        format!("{corrections} poses still differ by {residual}, which is above the tolerance")
    }
}

/// The lines to paste for a fault, and the difference before and after.
fn found(text: &mut String, fault: &Fault, stage: Option<&ReportedStage>) {
    // Outside of the snippet, whose width would break long lines.
    if fault.pasted.is_empty() {
        let _ = writeln!(text, "  to do: {}", fault.suggestion);
    } else {
        let _ = writeln!(text, "  to write:");
        fault.pasted.iter().for_each(|lines| indented(text, &lines.to_string()));
    }
    if let Some(ReportedStage { before, after }) = stage {
        let [before, after] =
            [before, after].map(|error| length_and_angle(error.position_m, error.orientation_rad));
        let after = if after == before { "not changed by it".to_owned() } else { format!("after: {after}") };
        let _ = writeln!(text, "  difference before: {before}, {after}\n");
    }
}

fn indented(text: &mut String, lines: &str) {
    for line in lines.lines() {
        let _ = writeln!(text, "    {line}");
    }
}

/// A cause that cannot be distinguished from the named one: what is other than there.
fn equivalent(text: &mut String, alternative: &ReportedAlternative, named: &[&Fault]) {
    let is_named = |fault: &&Fault| named.iter().any(|known| known.message == fault.message);
    let all: Vec<&Fault> = alternative.cause.faults().iter().collect();
    let others: Vec<&Fault> = all.iter().copied().filter(|fault| !is_named(fault)).collect();
    let others = if others.is_empty() { all } else { others };
    let messages: Vec<&str> = others.iter().map(|fault| fault.message.as_str()).collect();
    let _ = writeln!(text, "  indistinguishable: {} ({})", messages.join("; "), alternative.reason);
    for fault in others.into_iter().filter(|fault| !is_pasted(fault, named)) {
        fault.pasted.iter().for_each(|lines| indented(text, &lines.to_string()));
    }
}

/// Whether the lines to write for a fault are those of another one.
fn is_pasted(fault: &Fault, named: &[&Fault]) -> bool {
    !fault.pasted.is_empty() && named.iter().any(|known| known.pasted == fault.pasted)
}

/// A quantity in which the chains differ.
fn differs(text: &mut String, difference: &ReportedDifference) {
    let ReportedDifference { invariant, joint, found, expected } = difference;
    let [found, expected] = [found, expected].map(|value| quantity(*invariant, *value));
    let _ =
        writeln!(text, "    {:26} {joint:24} found {found:>12} expected {expected:>12}", words(*invariant));
}

fn words(invariant: Invariant) -> &'static str {
    match invariant {
        Invariant::Kind => "kind of joint",
        Invariant::Ratio => "motion for one unit",
        Invariant::AxisDistance => "distance to the next axis",
        Invariant::AxisAngle => "angle to the next axis",
        Invariant::Offset => "offset along the axis",
        Invariant::Sign => "direction of the next axis",
        Invariant::Zero => "angle at position zero",
        Invariant::Base => "pose of the first axis",
        Invariant::Tool => "pose of the tip",
    }
}

/// The value of an invariant; `none` if a chain does not have the quantity.
fn quantity(invariant: Invariant, value: f64) -> String {
    match invariant {
        _ if value.is_nan() => "none".to_owned(),
        Invariant::Kind => if value > 0.0 { "prismatic" } else { "revolute" }.to_owned(),
        Invariant::AxisDistance | Invariant::Offset => length(value),
        Invariant::AxisAngle | Invariant::Zero => angle(value),
        Invariant::Ratio | Invariant::Sign => number(value),
        // The norm of both parts of a pose, which has neither of their units alone.
        Invariant::Base | Invariant::Tool => format!("{} (m and rad)", number(value)),
    }
}

/// The table beside the nearest one that agrees: a row for each joint, `found -> expected *` if the two differ.
fn row_by_row(text: &mut String, table: &TableComparison) {
    let _ = writeln!(text, "  this table and the nearest one that agrees (* where they differ):");
    let is_constant = |value: &&ComparedValue| value.joint.is_none();
    let mut rows: Vec<(&str, Vec<String>)> = Vec::new();
    for value in table.values.iter().filter(|value| !is_constant(value)) {
        let joint = value.joint.as_deref().unwrap_or_default();
        if rows.last().is_none_or(|(last, _)| *last != joint) {
            rows.push((joint, Vec::new()));
        }
        if let Some((_, cells)) = rows.last_mut() {
            cells.push(cell(value));
        }
    }
    let names = column_width(rows.iter().map(|(joint, _)| joint.len()));
    let columns = rows.iter().map(|(_, cells)| cells.len()).max().unwrap_or(0);
    let width =
        |column: usize| column_width(rows.iter().filter_map(|(_, cells)| cells.get(column)).map(String::len));
    let widths: Vec<usize> = (0..columns).map(width).collect();
    for (joint, cells) in &rows {
        let padded = cells.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        let line = format!("    {joint:names$}  {}", padded.collect::<Vec<_>>().join("  "));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    for value in table.values.iter().filter(is_constant) {
        let _ = writeln!(text, "    {}", cell(value));
    }
}

fn cell(value: &ComparedValue) -> String {
    let ComparedValue { key, found, expected, differs, .. } = value;
    if *differs { format!("{key} = {found} -> {expected} *") } else { format!("{key} = {found}") }
}
