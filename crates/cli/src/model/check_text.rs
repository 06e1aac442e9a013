//! The report of `congruent check` as text for people.

use std::fmt::Write;

use congruent::{
    OtherDescription, RobotCheck,
    agreement::{
        SourcePair,
        compare::{
            Agreement, Basics, Brackets, BySource, CheckReport, Comparison, CoordinateUnit, NotAsked,
            PoseSource, Premise, ReportedBracket, ReportedCertificate,
        },
    },
    description::{
        Robot, Tolerance,
        display::{angle, length, length_and_angle},
    },
};

use super::{diagnosis_text::diagnosed, dynamics_text::dynamics};
use crate::terminal::table::{column_width, with_one_sign, wrapped};

/// The report before the errors at requested configurations.
pub(super) fn compared_text(check: &RobotCheck, robot: &Robot) -> String {
    let report = &check.geometry;
    let mut text = String::new();
    headline(&mut text, check);
    let _ = writeln!(text, "  {}", report.chain);
    if !report.table_compared && report.verdict != Agreement::NothingCompared {
        let agree = report.verdict == Agreement::Agree;
        let sources = if agree { "the URDF, its screws and the physics agree; " } else { "" };
        let _ = writeln!(text, "  {sources}no table was compared");
    }
    for comparison in &report.comparisons {
        compared(&mut text, comparison);
    }
    for NotAsked { source, findings } in &report.not_asked {
        let what = match *source {
            "simulation" => "not asked the physics:",
            "simulated_dynamics" => "not asked its forces:",
            "other_dynamics" => "not compared, torques:",
            _ => "not compared, [[inertial]]:",
        };
        for (index, finding) in findings.iter().enumerate() {
            let label = if index == 0 { what } else { "" };
            let _ = writeln!(text, "  {label:22} {}", finding.message);
        }
    }
    let poses_disagree = poses_disagree(report);
    if poses_disagree {
        let _ = writeln!(text, "  worst at link {}, at", report.worst.link);
        text += &wrapped(&report.worst.at.for_people(robot));
    }
    text
}

/// The report behind them.
pub(super) fn explained_text(check: &RobotCheck, robot: &Robot) -> String {
    let report = &check.geometry;
    let mut text = String::new();
    certified(&mut text, report, robot);
    if let Some(diagnosis) = report.diagnoses.iter().find(|diagnosis| !diagnosis.causes.is_empty()) {
        diagnosed(&mut text, diagnosis);
    }
    dynamics(&mut text, check, robot);
    text
}

/// Whether the disagreement is one of poses, and not of dynamics alone.
fn poses_disagree(report: &CheckReport) -> bool {
    report.comparisons.iter().any(|comparison| comparison.verdict == Agreement::Disagree)
}

/// Why nothing of the two descriptions was compared: they have other joints.
fn other_chain(check: &RobotCheck) -> Option<(&OtherDescription, &str)> {
    let against = check.against.as_ref()?;
    let mut compared = check.geometry.comparisons.iter().map(|of| of.name);
    let why = against.dynamics_not_compared.as_ref()?;
    (!compared.any(|name| name == SourcePair::UrdfOther)).then_some((against, why))
}

fn headline(text: &mut String, check: &RobotCheck) {
    let report = &check.geometry;
    if let Some((other, why)) = other_chain(check) {
        let _ = writeln!(
            text,
            "{}: disagree, not the same chain as {}: {why}; nothing of the two was compared",
            report.file, other.file
        );
        return;
    }
    if report.verdict == Agreement::NothingCompared {
        let _ = writeln!(
            text,
            "{}: nothing was compared: {}",
            report.file,
            Agreement::why_nothing(&report.chain)
        );
        return;
    }
    let tolerance = |tolerance: &Tolerance| length_and_angle(tolerance.position_m, tolerance.orientation_rad);
    let replaced = match &report.replaced_tolerance {
        Some(declared) => format!(" by --tolerance, the robot file's is {}", tolerance(declared)),
        None => String::new(),
    };
    let is_dynamics_alone = report.verdict == Agreement::Disagree && !poses_disagree(report);
    let dynamics_alone = if is_dynamics_alone { " in dynamics, and agree in poses" } else { "" };
    let _ = writeln!(
        text,
        "{}: {}{}, worst {} of the links that decide, over {} configurations (tolerance {}{replaced})",
        report.file,
        report.verdict,
        dynamics_alone,
        length_and_angle(report.worst.error.position_m, report.worst.error.orientation_rad),
        report.configurations,
        tolerance(&report.tolerance),
    );
}

/// The first checks: the pose of the TCP at zero and its motion with each joint.
pub(super) fn basics(basics: &Basics) -> String {
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
    let rounded = values.iter().map(|value| format!("{:9.3}", (value * 1e3).round() / 1e3 + 0.0));
    rounded.collect::<Vec<_>>().join(" ")
}

fn to_mm(metres: f64) -> f64 {
    metres * 1e3
}

/// The certificate: a bound over the whole joint range, not a sample.
fn certified(text: &mut String, report: &CheckReport, robot: &Robot) {
    if !poses_disagree(report) {
        report.certificates.iter().for_each(|certificate| narrow(text, certificate));
        return;
    }
    let mut line = |what: &str, bracket: &ReportedBracket, shown: fn(f64) -> String| {
        let _ = writeln!(
            text,
            "  worst {what} disagreement {}, certified below {} over the whole joint range, at",
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
            PoseSource::DhFitted => "(constant fitted at zero, does not decide)",
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
