//! The page of a calibration.

use base64::{Engine, prelude::BASE64_STANDARD};
use congruent_calibration::{
    estimation::ParameterUnit,
    report::{
        CalibrationReport, CalibrationVerdict, EstimatedCorrection, Recommendation, ResidualSummary,
        RowResidual, plot,
    },
};
use congruent_description::Robot;
use congruent_input::display::{angle, counted, length, number};
use maud::{Markup, html};

use crate::parts::{BadgeKind, Pointer, badge, capitalised, count, document, value, warnings};

/// Rows of the table of residuals that are shown; the report has all.
const MOST_ROWS: usize = 200;

/// The page of a calibration of this robot.
pub fn calibration_page(report: &CalibrationReport, robot: &Robot) -> String {
    let body = html! {
        (header(report))
        (corrections(report))
        (drawing(report))
        (residuals(report))
        (rows(report))
        (next(report, robot))
        (warnings(&report.warnings))
    };
    document(&format!("{}: calibration", report.robot), &body, None)
}

fn outcome(verdict: CalibrationVerdict) -> (BadgeKind, &'static str) {
    match verdict {
        CalibrationVerdict::Explained => (BadgeKind::Good, "EXPLAINED"),
        CalibrationVerdict::UnexplainedRows => (BadgeKind::Unclear, "EXPLAINED, EXCEPT OUTLIERS"),
        CalibrationVerdict::NoImprovement => (BadgeKind::Unclear, "NO IMPROVEMENT"),
        CalibrationVerdict::NoiseExceeded => (BadgeKind::Bad, "RESIDUAL ABOVE THE NOISE"),
        CalibrationVerdict::Unexplained => (BadgeKind::Bad, "NOT EXPLAINED"),
        CalibrationVerdict::Misinterpreted => (BadgeKind::Bad, "FILE LIKELY IN OTHER UNITS, ORDER OR FRAME"),
        CalibrationVerdict::TooLarge => (BadgeKind::Bad, "CORRECTIONS TOO LARGE"),
        CalibrationVerdict::Unverifiable => (BadgeKind::Unclear, "CANNOT BE VERIFIED"),
        CalibrationVerdict::NothingIdentified => (BadgeKind::Unclear, "NOTHING IDENTIFIED"),
    }
}

fn header(report: &CalibrationReport) -> Markup {
    let (outcome, word) = outcome(report.verdict);
    let root = Pointer::root();
    let mut statements = report.statements.iter();
    html! {
        header {
            p.kind { "Calibration from measurements" }
            h1 { (report.robot) }
            p.verdict { (badge(outcome, word)) }
            @if let Some(first) = statements.next() { p { (capitalised(first)) "." } }
            @for statement in statements { p.small { (capitalised(statement)) "." } }
            dl.facts {
                dt { "measurements" }
                dd {
                    (count(&root.key("rows"), report.rows)) " of " (report.measured_frame) ", "
                    (count(&root.key("components"), report.components)) " components, redundancy "
                    (count(&root.key("redundancy"), report.redundancy))
                }
                dt { "corrected" } dd { (report.model) ", " (report.chain) }
                dt { "use" }
                dd {
                    @match report.recommended {
                        Recommendation::Nominal => "the nominal model",
                        Recommendation::LeastSquares => "least squares",
                        Recommendation::Robust => "the robust estimate",
                    }
                }
            }
        }
    }
}

fn corrections(report: &CalibrationReport) -> Markup {
    html! {
        @if !report.parameters.is_empty() {
            section {
                h2 { "Corrections" }
                table {
                    thead { tr { th { "correction" } th { "least squares" } th { (report.loss) } th { "significant" } th { "in the robot file" } } }
                    tbody {
                        @for (index, each) in report.parameters.iter().enumerate() {
                            (correction(each, report, &Pointer::root().key("parameters").key(index)))
                        }
                    }
                }
            }
        }
        @if !report.fixed.is_empty() {
            details {
                summary { (counted(report.fixed.len(), "correction")) " fixed at nominal, since the measurements do not identify them" }
                ul { @for each in &report.fixed { li { b { (each.name) } ": " (each.reason) } } }
            }
        }
    }
}

fn correction(each: &EstimatedCorrection, report: &CalibrationReport, at: &Pointer) -> Markup {
    let estimate = |key: &str, deviation_key: &str, correction: f64, deviation: f64| {
        let shown = |value: f64| shown(each.unit, value);
        html! {
            (value(&at.key(key), correction, &shown(correction)))
            @if deviation.is_finite() { " ± " (value(&at.key(deviation_key), deviation, &shown(deviation))) }
            @else { " ± unknown" }
        }
    };
    let is_recommended = report.recommended != Recommendation::Nominal;
    html! {
        tr {
            th scope="row" { (each.name) }
            td data-label="least squares" { (estimate("correction", "standard_deviation", each.correction, each.standard_deviation)) }
            td data-label="robust" { (estimate("robust_correction", "robust_standard_deviation", each.robust_correction, each.robust_standard_deviation)) }
            td data-label="significant" { @if each.significant { "yes" } @else { "no" } }
            td data-label="in the file" {
                @if let Some(table) = each.in_table.as_ref().filter(|_| is_recommended) {
                    "line " (table.line) ": " code { (table.entry) "_" (each.unit.name_for_people()) } " "
                    (value(&at.keys(&["in_table", "nominal"]), table.nominal, &to_write(each.unit, table.nominal))) " to "
                    (value(&at.keys(&["in_table", "corrected"]), table.corrected, &to_write(each.unit, table.corrected)))
                }
            }
        }
    }
}

/// A value of the robot file in the unit of its key, with more digits than a measurement determines.
fn to_write(unit: ParameterUnit, value: f64) -> String {
    format!("{:.4}", unit.for_people(value))
}

fn shown(unit: ParameterUnit, value: f64) -> String {
    match unit {
        ParameterUnit::Angle => angle(value),
        ParameterUnit::Length => length(value),
    }
}

/// The plot of `calibrate --plot`, as an image: nothing in it can run or fetch.
fn drawing(report: &CalibrationReport) -> Markup {
    let Ok(svg) = plot::svg(report) else { return html! {} };
    let source = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg));
    html! { section { figure { img.drawing src=(source) alt="cost over the most significant correction, and the residual of each measurement"; } } }
}

fn residuals(report: &CalibrationReport) -> Markup {
    let root = Pointer::root();
    let loss = report.loss.to_string();
    let models = [
        ("nominal", &report.nominal, "nominal"),
        ("least squares", &report.least_squares.residuals, "least_squares"),
        (loss.as_str(), &report.robust.residuals, "robust"),
    ];
    html! {
        section {
            h2 { "Residuals" }
            table {
                thead { tr { th { "model" } th { "root mean square" } th { "worst" } } }
                tbody {
                    @for (name, residuals, key) in models { (summary(name, residuals, &root.key(key))) }
                    @if let Some(held_out) = &report.held_out {
                        @let at = root.key("held_out");
                        tr {
                            th scope="row" { "held out, " (count(&at.key("folds"), held_out.folds)) " folds" }
                            td data-label="root mean square" { (both([(&at.key("rms_m"), held_out.rms_m), (&at.key("rms_rad"), held_out.rms_rad)])) }
                            td data-label="nominal there" {
                                "nominal on the same rows "
                                (both([(&at.key("nominal_rms_m"), held_out.nominal_rms_m), (&at.key("nominal_rms_rad"), held_out.nominal_rms_rad)]))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn summary(name: &str, of: &ResidualSummary, at: &Pointer) -> Markup {
    html! {
        tr {
            th scope="row" { (name) }
            td data-label="root mean square" { (both([(&at.key("rms_m"), of.rms_m), (&at.key("rms_rad"), of.rms_rad)])) }
            td data-label="worst" { (both([(&at.key("worst_m"), of.worst_m), (&at.key("worst_rad"), of.worst_rad)])) }
        }
    }
}

/// A length, and an angle if there is one.
fn both([(at_m, metres), (at_rad, radians)]: [(&Pointer, f64); 2]) -> Markup {
    html! {
        (value(at_m, metres, &length(metres)))
        @if radians > 0.0 { " and " (value(at_rad, radians, &angle(radians))) }
    }
}

fn rows(report: &CalibrationReport) -> Markup {
    let is_outlier = |row: &RowResidual| report.outliers.iter().any(|outlier| outlier.row == row.row);
    html! {
        details {
            summary {
                "residual of each measurement"
                @if !report.outliers.is_empty() { ", " (counted(report.outliers.len(), "outlier")) }
            }
            table {
                thead { tr { th { "measurement" } th { "nominal" } th { "least squares" } th { (report.loss) } th { "weight" } } }
                tbody {
                    @for (index, row) in report.row_residuals.iter().enumerate().take(MOST_ROWS) {
                        @let at = Pointer::root().key("row_residuals").key(index);
                        tr {
                            th scope="row" {
                                (row.row) span.small { " line " (row.line) }
                                @if is_outlier(row) { " " (badge(BadgeKind::Unclear, "outlier")) }
                            }
                            td data-label="nominal" { (both([(&at.key("nominal_m"), row.nominal_m), (&at.key("nominal_rad"), row.nominal_rad)])) }
                            td data-label="least squares" { (both([(&at.key("least_squares_m"), row.least_squares_m), (&at.key("least_squares_rad"), row.least_squares_rad)])) }
                            td data-label="robust" { (both([(&at.key("robust_m"), row.robust_m), (&at.key("robust_rad"), row.robust_rad)])) }
                            td data-label="weight" { (value(&at.key("weight"), row.weight, &number(row.weight))) }
                        }
                    }
                }
            }
        }
    }
}

fn next(report: &CalibrationReport, robot: &Robot) -> Markup {
    html! {
        @if !report.next.is_empty() {
            details {
                summary { "most informative to measure next" }
                p.small { "Within the joint limits; not checked for collisions." }
                ol {
                    @for (index, pose) in report.next.iter().enumerate() {
                        @let at = Pointer::root().key("next").key(index).key("gain_bits");
                        li { (pose.q.for_people(robot)) " (" (value(&at, pose.gain_bits, &number(pose.gain_bits))) " bit)" }
                    }
                }
            }
        }
    }
}
