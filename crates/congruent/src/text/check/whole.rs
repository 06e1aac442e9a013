//! The report of `congruent check` as text for people.

use std::{
    fmt::Write,
    iter::{empty, once, once_with},
};

use crate::{
    RobotCheck, WrittenFix,
    agreement::{
        SourcePair,
        compare::{
            Agreement, Basics, Brackets, BySource, CheckReport, ComparedSource, Comparison, CoordinateUnit,
            Grade, NotCompared, PoseSource, Premise, ReportedBracket, ReportedCertificate,
        },
    },
    description::Robot,
    input::display::{angle, length, length_and_angle},
    text::{
        TextOptions,
        layout::{column_width, with_one_sign, wrapped},
    },
};

use super::{
    diagnosis::{diagnosed, rounded},
    dynamics::dynamics,
    errors_at::{lines, table},
};

/// What else the text has.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CheckTextParts {
    /// The pose of the TCP at zero and its motion with each joint (`--basics`).
    pub with_basics: bool,
    /// The errors at requested configurations as a table with the position of the tip by both models (`--table`), and
    /// not as one line each.
    pub with_table: bool,
}

/// What `congruent check` prints of a robot: the answer, the comparisons, and if they disagree the cause with the lines
/// to write.
///
/// # Examples
/// ```
/// use congruent::{
///     prelude::*,
///     text::{CheckTextParts, TextOptions, check_text},
/// };
///
/// # let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r");
/// let description = load_robot(folder.as_ref())?;
/// let report = check(&description, &CheckOptions::default())?;
/// let options = TextOptions::default();
/// let text = check_text(&report, &description.robot, CheckTextParts::default(), &options);
/// let printed = options.for_terminal(&text);
/// assert!(printed.starts_with(&format!("{}: same robot.", report.geometry.file)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check_text(check: &RobotCheck, robot: &Robot, parts: CheckTextParts, options: &TextOptions) -> String {
    check_text_parts(check, robot, parts, options).collect()
}

/// The same in parts of whole lines, which are made one after the other: the errors at many configurations are never in
/// memory as one text.
pub fn check_text_parts<'a>(
    check: &'a RobotCheck,
    robot: &'a Robot,
    parts: CheckTextParts,
    options: &'a TextOptions,
) -> impl Iterator<Item = String> + 'a {
    let at_configurations = match &check.at_configurations {
        Some(differences) if parts.with_table => table(&check.geometry, differences, options),
        Some(differences) => lines(differences),
        None => Box::new(empty()),
    };
    let basics = if parts.with_basics { basics(&check.geometry.basics) } else { String::new() };
    let explained = once_with(move || explained_text(check, robot, options) + &basics);
    once(compared_text(check, robot)).chain(at_configurations).chain(explained)
}

/// The report before the errors at requested configurations.
fn compared_text(check: &RobotCheck, robot: &Robot) -> String {
    let report = &check.geometry;
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}", report.file, check.headline());
    let _ = writeln!(text, "  {}", report.chain);
    for comparison in &report.comparisons {
        compared(&mut text, comparison);
    }
    for NotCompared { source, findings } in &report.not_asked {
        let what = match source {
            ComparedSource::Simulation => "physics not compared:",
            ComparedSource::SimulatedDynamics => "physics torques not compared:",
            ComparedSource::OtherDynamics => "torques of the other URDF not compared:",
            ComparedSource::DeclaredDynamics => "[[inertial]] not compared:",
        };
        let width = what.len();
        for (index, finding) in findings.iter().enumerate() {
            let label = if index == 0 { what } else { "" };
            let _ = writeln!(text, "  {label:width$} {}", finding.message);
        }
    }
    // Only then: the largest error of models that agree is rounding, and its place means nothing.
    let poses_disagree = report.poses_disagree();
    if poses_disagree {
        let _ = writeln!(text, "  largest error at link {}, at", report.worst.link);
        text += &wrapped(&report.worst.at.for_people(robot));
    }
    text
}

/// The report behind them.
fn explained_text(check: &RobotCheck, robot: &Robot, options: &TextOptions) -> String {
    let report = &check.geometry;
    let mut text = String::new();
    certified(&mut text, report, robot);
    let diagnosis = check.diagnosis();
    if let Some(diagnosis) = diagnosis {
        diagnosed(&mut text, diagnosis, &report.tolerance, options);
    }
    if report.poses_disagree() && report.grade == Some(Grade::SameWithinDigits) {
        rounded(&mut text, report);
    }
    dynamics(&mut text, check, robot);
    if let Some(corrected) = diagnosis.and_then(|diagnosis| diagnosis.corrected.as_ref()) {
        let _ = writeln!(text, "  the table of {}, corrected:\n\n{}", corrected.file, corrected.table());
    }
    if let Some(fix) = &check.fix {
        fixed(&mut text, fix);
    }
    text
}

/// What `--fix` has written, and the answer of its check.
fn fixed(text: &mut String, fix: &WrittenFix) {
    let WrittenFix { file, statement, .. } = fix;
    let _ = match file {
        Some(file) => writeln!(text, "  written: {file}\n  checked again: {statement}"),
        None => writeln!(text, "  nothing written: {statement}"),
    };
}

/// The first checks: the pose of the TCP at zero and its motion with each joint.
fn basics(basics: &Basics) -> String {
    let mut text = format!("  the TCP on {}, in the axes of {}:\n", basics.tip, basics.base);
    let width = column_width(basics.joints.iter().map(|joint| joint.joint.len()));
    by_source(&mut text, &format!("{:width$} {:8}", "at zero", ""), &basics.zero, |pose| {
        let [at, quaternion] =
            [&pose.translation_m.map(to_mm)[..], &with_one_sign(pose.quaternion_wxyz)].map(listed);
        format!("at    {at} mm  quaternion {quaternion}")
    });
    for joint in &basics.joints {
        let by = match joint.unit {
            CoordinateUnit::M => format!("{:+} mm", to_mm(joint.by)),
            CoordinateUnit::Rad => format!("{:+} deg", joint.by.to_degrees().round()),
        };
        by_source(&mut text, &format!("{:width$} {by:>8}", joint.joint), &joint.motion, |motion| {
            let [shift, turn] = [motion.shift_m.map(to_mm), motion.turn_rad.map(f64::to_degrees)];
            format!("shift {} mm  turn {} deg", listed(&shift), listed(&turn))
        });
    }
    let _ = writeln!(
        text,
        "    worst over all configurations: |R'R - I| {:.1e}, |det R - 1| {:.1e}, T T^-1 off by {:.1e} m and {:.1e} rad",
        basics.orthonormality_error, basics.determinant_error, basics.round_trip_m, basics.round_trip_rad
    );
    text
}

/// One line if table and URDF have the same values, otherwise one line for each.
fn by_source<T>(text: &mut String, label: &str, by: &BySource<T>, shown: impl Fn(&T) -> String) {
    let lines: Vec<(&str, String)> = by.named().map(|(source, value)| (source, shown(value))).collect();
    let lines: &[(&str, String)] = match &lines[..] {
        [(_, table), (_, urdf)] if table == urdf => &[("both", table.clone())],
        lines => lines,
    };
    for (source, line) in lines {
        let _ = writeln!(text, "    {label} {source:5}  {line}");
    }
}

/// Three decimals each, and no minus before a zero.
fn listed(values: &[f64]) -> String {
    // Adding 0 turns a negative zero into 0.
    let rounded = values.iter().map(|value| format!("{:9.3}", (value * 1e3).round() / 1e3 + 0.0));
    rounded.collect::<Vec<_>>().join(" ")
}

fn to_mm(metres: f64) -> f64 {
    metres * 1e3
}

/// The certificate: a bound over the whole joint range, not a sample.
fn certified(text: &mut String, report: &CheckReport, robot: &Robot) {
    if !report.poses_disagree() {
        report.certificates.iter().for_each(|certificate| narrow(text, certificate));
        return;
    }
    let mut line = |what: &str, bracket: &ReportedBracket, shown: fn(f64) -> String| {
        let _ = writeln!(
            text,
            "  largest {what} difference {}, certified at most {} over the whole joint range, at",
            shown(bracket.attained),
            shown(bracket.certified)
        );
        *text += &wrapped(&bracket.at.for_people(robot));
    };
    if let Some(Brackets { position_m, orientation_rad }) = &report.certificate_bracket {
        line("position", position_m, length);
        line("orientation", orientation_rad, angle);
    }
}

/// The certificate of models that agree, with its premise.
fn narrow(text: &mut String, certificate: &ReportedCertificate) {
    let ReportedCertificate { name, title, brackets, premise } = certificate;
    if let Some(Brackets { position_m, orientation_rad }) = brackets {
        let bound = length_and_angle(position_m.certified, orientation_rad.certified);
        let _ = writeln!(text, "  certified  {title:32} at most {bound} over the whole joint range");
    }
    if let Some(Premise { configurations, residual_m, residual_rad, holds }) = premise {
        let verified = if *holds { "verified as" } else { "are not" };
        let whose = if *name == SourcePair::UrdfOther { "the other URDF's" } else { "simulated" };
        let residual = length_and_angle(*residual_m, *residual_rad);
        let _ = writeln!(
            text,
            "    {whose} joints {verified} pure screw motions: residual {residual} at {configurations} configurations"
        );
    }
}

fn compared(text: &mut String, comparison: &Comparison) {
    let _ = writeln!(
        text,
        "  {:9} {:32} {:>12}  {:>12}  at {}",
        comparison.verdict,
        comparison.title,
        length(comparison.worst.error.position_m),
        angle(comparison.worst.error.orientation_rad),
        comparison.worst.link
    );
    if comparison.verdict == Agreement::Agree {
        return;
    }
    for link in &comparison.links {
        let fitted = match link.source {
            PoseSource::DhFitted => "(the table does not define this frame: for information only)",
            _ => "",
        };
        let _ = writeln!(
            text,
            "            {:32} {:>12}  {:>12}  {fitted}",
            link.link,
            length(link.error.position_m),
            angle(link.error.orientation_rad)
        );
    }
}
