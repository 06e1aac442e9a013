//! The page of a calibration.

use std::fmt::Write;

use base64::{Engine, prelude::BASE64_STANDARD};
use congruent_calibration::{
    estimation::ParameterUnit,
    report::{
        CalibrationReport, CalibrationVerdict, EstimatedCorrection, Recommendation, RowEntry, RowResidual,
        plot,
    },
};
use congruent_description::{DhRow, DhTable, Robot, RobotDescription};
use congruent_input::{
    InputFile,
    display::{counted, number},
    portable_path,
};
use congruent_writers::dh_section;
use maud::{Markup, html};

use crate::camera::camera_section;
use crate::parts::{
    BadgeKind, Pointer, Provenance, UnitColumn, badge, capitalised, count, document, provenance, value,
    warnings,
};

/// Rows of the table of residuals that are shown; the report has all.
const MOST_ROWS: usize = 200;

/// What a calibration was made from, which its report does not have.
#[derive(Debug, Clone, Default)]
pub struct CalibrationSource {
    /// The call that made it.
    pub command: String,
    /// The file of the measurements.
    pub measurements: Option<InputFile>,
}

/// The page of a calibration of this robot.
pub fn calibration_page(
    report: &CalibrationReport,
    description: &RobotDescription,
    source: &CalibrationSource,
) -> String {
    let inputs: Vec<InputFile> = description.inputs.iter().chain(&source.measurements).cloned().collect();
    let origin = Provenance {
        command: Some(source.command.clone()),
        inputs: inputs.iter().collect(),
        remarks: Vec::new(),
    };
    let body = html! {
        (header(report, description))
        (corrections(report))
        (camera_section(report.camera.as_ref()))
        (to_paste(report, description))
        (drawing(report))
        (residuals(report))
        (rows(report))
        (next(report, &description.robot))
        (provenance(&origin))
        (warnings(&report.warnings))
    };
    document(&format!("{}: calibration", report.robot), &body, None, &inputs)
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
        CalibrationVerdict::CameraUndetermined => (BadgeKind::Unclear, "CAMERA NOT DETERMINED"),
        CalibrationVerdict::NothingIdentified => (BadgeKind::Unclear, "NOTHING IDENTIFIED"),
    }
}

fn header(report: &CalibrationReport, description: &RobotDescription) -> Markup {
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
                dt { "file" } dd { code { (portable_path(&description.path).display()) } }
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
    // Angles and lengths in tables of their own: one unit for each column.
    let of_unit = |unit: ParameterUnit| -> Vec<(usize, &EstimatedCorrection)> {
        report.parameters.iter().enumerate().filter(|(_, each)| each.unit == unit).collect()
    };
    html! {
        @if !report.parameters.is_empty() {
            section {
                h2 { "Corrections" }
                @for unit in [ParameterUnit::Angle, ParameterUnit::Length] {
                    @let of_unit = of_unit(unit);
                    @if !of_unit.is_empty() { (corrections_of(&of_unit, unit, report)) }
                }
            }
        }
        @if !report.fixed.is_empty() {
            details {
                summary { (counted(report.fixed.len(), "correction")) " fixed at " (report.held_at()) ", since the measurements do not identify them" }
                ul { @for each in &report.fixed { li { b { (each.name) } ": " (each.reason) @if let Some(at) = each.held_at_for_people() { ", " (at) } } } }
            }
        }
    }
}

fn corrections_of(
    of_unit: &[(usize, &EstimatedCorrection)],
    unit: ParameterUnit,
    report: &CalibrationReport,
) -> Markup {
    let name = unit.name_for_people();
    html! {
        table {
            thead { tr {
                th { "correction" } th { "least squares, " (name) } th { (report.loss) ", " (name) } th { "significant" }
                th { "line" } th { "in the robot file, " (name) }
            } }
            tbody {
                @for (index, each) in of_unit {
                    (correction(each, report, &Pointer::root().key("parameters").key(index)))
                }
            }
        }
    }
}

fn correction(each: &EstimatedCorrection, report: &CalibrationReport, at: &Pointer) -> Markup {
    let estimate = |key: &str, deviation_key: &str, correction: f64, deviation: f64| {
        html! {
            (value(&at.key(key), correction, &to_write(each.unit, correction)))
            @if deviation.is_finite() { " ± " (value(&at.key(deviation_key), deviation, &to_write(each.unit, deviation))) }
            @else { " ± unknown" }
        }
    };
    let table = each.in_table.as_ref().filter(|_| report.recommended != Recommendation::Nominal);
    html! {
        tr {
            th scope="row" { (each.name) }
            td data-label="least squares" { (estimate("correction", "standard_deviation", each.correction, each.standard_deviation)) }
            td data-label="robust" { (estimate("robust_correction", "robust_standard_deviation", each.robust_correction, each.robust_standard_deviation)) }
            td data-label="significant" { @if each.significant { "yes" } @else { "no" } }
            @if let Some(table) = table {
                td data-label="line" { (table.line) }
                td data-label="in the file" {
                    code { (table.entry) "_" (each.unit.name_for_people()) } " "
                    (value(&at.keys(&["in_table", "nominal"]), table.nominal, &to_write(each.unit, table.nominal))) " to "
                    (value(&at.keys(&["in_table", "corrected"]), table.corrected, &to_write(each.unit, table.corrected)))
                }
            } @else { td {} td {} }
        }
    }
}

/// The section `[dh]` with the recommended corrections, to paste; nothing if none is a value of the table.
fn to_paste(report: &CalibrationReport, description: &RobotDescription) -> Markup {
    let Some(table) = corrected_table(report, description) else { return html! {} };
    html! {
        section {
            h2 { "To paste" }
            p.small {
                "The section " code { "[dh]" } " of " code { (portable_path(&description.path).display()) }
                " with the significant ones of the recommended corrections; those of base and tool are not in it."
            }
            pre.paste { (with_changes(&dh_section(&table, &description.robot), &nominal(description))) }
        }
    }
}

fn nominal(description: &RobotDescription) -> String {
    description.dh.as_ref().map_or_else(String::new, |table| dh_section(table, &description.robot))
}

/// The section with what each changed line was, as a comment.
fn with_changes(section: &str, nominal: &str) -> String {
    let mut text = String::new();
    for (line, before) in section.lines().zip(nominal.lines().chain(std::iter::repeat(""))) {
        let was = before.split_once(" = ").map_or("", |(_, value)| value);
        let comment = if line == before || was.is_empty() { String::new() } else { format!("  # was {was}") };
        let _ = writeln!(text, "{line}{comment}");
    }
    text
}

/// The table with the recommended corrections that are significant.
fn corrected_table(report: &CalibrationReport, description: &RobotDescription) -> Option<DhTable> {
    if report.recommended == Recommendation::Nominal {
        return None;
    }
    let mut table = description.dh.clone()?;
    let mut is_corrected = false;
    for each in report.parameters.iter().filter(|each| each.significant) {
        // A name is `<joint>.<entry>`.
        let (Some(to), Some((joint, _))) = (&each.in_table, each.name.rsplit_once('.')) else { continue };
        let of_joint = |row: &&mut DhRow| description.robot.joint(row.joint).name == joint;
        let Some(row) = table.rows.iter_mut().find(of_joint) else { continue };
        let entry = match to.entry {
            RowEntry::Theta => &mut row.theta_rad,
            RowEntry::D => &mut row.d_m,
            RowEntry::A => &mut row.a_m,
            RowEntry::Alpha => &mut row.alpha_rad,
        };
        *entry = written(each.unit, to.corrected);
        is_corrected = true;
    }
    is_corrected.then_some(table)
}

/// A corrected value with the digits of the table of corrections: more would be noise.
fn written(unit: ParameterUnit, value: f64) -> f64 {
    let scale = unit.for_people(1.0);
    let rounded = (value * scale * 1e4).round() / 1e4;
    match unit {
        ParameterUnit::Angle => rounded.to_radians(),
        ParameterUnit::Length => rounded / scale,
    }
}

/// A value of the robot file in the unit of its key, with more digits than a measurement determines.
fn to_write(unit: ParameterUnit, value: f64) -> String {
    format!("{:.4}", unit.for_people(value))
}

/// The plot of `calibrate --plot`, as an image: nothing in it can run or fetch.
fn drawing(report: &CalibrationReport) -> Markup {
    let Ok(svg) = plot::svg(report) else { return html! {} };
    let source = format!("data:image/svg+xml;base64,{}", BASE64_STANDARD.encode(svg));
    html! { section { figure { img.drawing src=(source) alt="cost over the most significant correction, and the residual of each measurement"; } } }
}

/// Units of the columns of residuals, and whether orientations were measured.
struct Residuals {
    length: UnitColumn,
    angle: UnitColumn,
    has_angles: bool,
}

impl Residuals {
    fn new(of: &[[f64; 2]]) -> Self {
        Self {
            length: UnitColumn::of_lengths(of.iter().map(|of| of[0])),
            angle: UnitColumn::of_angles(of.iter().map(|of| of[1])),
            has_angles: of.iter().any(|of| of[1] > 0.0),
        }
    }

    fn headings(&self, names: &[&str]) -> Markup {
        html! {
            @for name in names {
                th { (name) ", " (self.length.unit) }
                @if self.has_angles { th { (name) ", " (self.angle.unit) } }
            }
        }
    }

    /// A length, and an angle if there are any, in columns of their own.
    fn cells(&self, name: &str, [(at_m, metres), (at_rad, radians)]: [(&Pointer, f64); 2]) -> Markup {
        html! {
            td data-label=(format!("{name}, {}", self.length.unit)) { (value(at_m, metres, &self.length.words(metres))) }
            @if self.has_angles {
                td data-label=(format!("{name}, {}", self.angle.unit)) { (value(at_rad, radians, &self.angle.words(radians))) }
            }
        }
    }
}

fn residuals(report: &CalibrationReport) -> Markup {
    let root = Pointer::root();
    let loss = report.loss.to_string();
    let models = [
        ("nominal", &report.nominal, "nominal"),
        ("least squares", &report.least_squares.residuals, "least_squares"),
        (loss.as_str(), &report.robust.residuals, "robust"),
    ];
    let of_models = models.iter().flat_map(|(_, of, _)| [[of.rms_m, of.rms_rad], [of.worst_m, of.worst_rad]]);
    let columns = Residuals::new(&of_models.collect::<Vec<_>>());
    html! {
        section {
            h2 { "Residuals" }
            table {
                thead { tr { th { "model" } (columns.headings(&["root mean square", "worst"])) } }
                tbody {
                    @for (name, of, key) in models {
                        @let at = root.key(key);
                        tr {
                            th scope="row" { (name) }
                            (columns.cells("root mean square", [(&at.key("rms_m"), of.rms_m), (&at.key("rms_rad"), of.rms_rad)]))
                            (columns.cells("worst", [(&at.key("worst_m"), of.worst_m), (&at.key("worst_rad"), of.worst_rad)]))
                        }
                    }
                }
            }
            @if let Some(of) = &report.held_out {
                @let at = root.key("held_out");
                h3 { "On rows that were held out, " (count(&at.key("folds"), of.folds)) " folds" }
                table {
                    thead { tr { th { "model" } (columns.headings(&["root mean square"])) } }
                    tbody {
                        tr {
                            th scope="row" { "recommended" }
                            (columns.cells("root mean square", [(&at.key("rms_m"), of.rms_m), (&at.key("rms_rad"), of.rms_rad)]))
                        }
                        tr {
                            th scope="row" { "nominal" }
                            (columns.cells("root mean square", [(&at.key("nominal_rms_m"), of.nominal_rms_m), (&at.key("nominal_rms_rad"), of.nominal_rms_rad)]))
                        }
                    }
                }
            }
        }
    }
}

fn rows(report: &CalibrationReport) -> Markup {
    let of_rows = report.row_residuals.iter().flat_map(|row| {
        [
            [row.nominal_m, row.nominal_rad],
            [row.least_squares_m, row.least_squares_rad],
            [row.robust_m, row.robust_rad],
        ]
    });
    let (columns, loss) = (Residuals::new(&of_rows.collect::<Vec<_>>()), report.loss.to_string());
    let is_outlier = |row: &RowResidual| report.outliers.iter().any(|outlier| outlier.row == row.row);
    html! {
        details {
            summary {
                "residual of each measurement"
                @if !report.outliers.is_empty() { ", " (counted(report.outliers.len(), "outlier")) }
            }
            table {
                thead { tr { th { "measurement" } (columns.headings(&["nominal", "least squares", &loss])) th { "weight" } } }
                tbody {
                    @for (index, row) in report.row_residuals.iter().enumerate().take(MOST_ROWS) {
                        @let at = Pointer::root().key("row_residuals").key(index);
                        tr {
                            th scope="row" {
                                (row.row) span.small { " line " (row.line) }
                                @if is_outlier(row) { " " (badge(BadgeKind::Unclear, "outlier")) }
                            }
                            (columns.cells("nominal", [(&at.key("nominal_m"), row.nominal_m), (&at.key("nominal_rad"), row.nominal_rad)]))
                            (columns.cells("least squares", [(&at.key("least_squares_m"), row.least_squares_m), (&at.key("least_squares_rad"), row.least_squares_rad)]))
                            (columns.cells("robust", [(&at.key("robust_m"), row.robust_m), (&at.key("robust_rad"), row.robust_rad)]))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_to_paste_says_what_it_was() {
        let (nominal, corrected) =
            ("[dh]\na_m = 0.6\ntheta_deg = 0.0\n", "[dh]\na_m = 0.6\ntheta_deg = 0.6386\n");
        assert_eq!(with_changes(corrected, nominal), "[dh]\na_m = 0.6\ntheta_deg = 0.6386  # was 0.0\n");
    }
}
