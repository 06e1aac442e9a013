//! `congruent check`: model against URDF against twin.

use std::{fmt::Write, path::PathBuf};

use congruent::{
    agreement::{
        compare::{
            Agreement, Basics, Brackets, BySource, CheckOptions, CheckReport, Comparison, PoseSource,
            Premise, ReportedBracket, ReportedCertificate,
        },
        report::{Fault, ReportedCause, ReportedDiagnosis},
    },
    description::{Diagnostic, load_robot, read_configurations},
};

use crate::{
    failure::Failure,
    print::{Printer, rendered},
};

/// Whether a robot's table, its URDF and its physics twin are the same robot.
///
/// Compared at zero, one axis at a time, at 200 seeded random configurations within the limits,
/// at the limits, and where the certificates find the worst. Exit code 1 where they disagree.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Folders with robot.toml, robot files, or bare .urdf files.
    #[arg(required = true)]
    robots: Vec<PathBuf>,
    /// Seed of the random configurations.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Compare at these as well and show the difference at each: a JSON array of
    /// {"q": {"joint": value}} in rad and m; joints that are not named are at 0.
    #[arg(long, value_name = "FILE")]
    configurations: Option<PathBuf>,
    /// Show too where the TCP is at zero and which way each joint moves it; JSON always has it.
    #[arg(long)]
    basics: bool,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let mut reports = Vec::with_capacity(arguments.robots.len());
    for path in &arguments.robots {
        let description = load_robot(path)?;
        printer.warnings(&description.warnings);
        let configurations = match &arguments.configurations {
            Some(path) => read_configurations(path, &description.robot)?,
            None => Vec::new(),
        };
        let report =
            congruent::check(&description, &CheckOptions { seed: arguments.seed, configurations })
                .map_err(|error| Diagnostic::error("check::robot", format!("{}: {error}", path.display())))?;
        reports.push(report);
    }
    let text = |report: &CheckReport| {
        let basics = if arguments.basics { basics(&report.basics) } else { String::new() };
        text(report) + &basics
    };
    let all_agree = reports.iter().all(|report| report.verdict == Agreement::Agree);
    match &reports[..] {
        [report] => printer.result(report, text)?,
        reports => printer.result(&reports, |reports| reports.iter().map(text).collect())?,
    }
    Ok(u8::from(!all_agree))
}

fn text(report: &CheckReport) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {}, worst {} and {} over {} configurations (tolerance {:e} m, {:e} rad)",
        report.robot,
        word(report.verdict),
        length(report.worst.error.position_m),
        angle(report.worst.error.orientation_rad),
        report.configurations,
        report.tolerance.position_m,
        report.tolerance.orientation_rad
    );
    for comparison in &report.comparisons {
        compared(&mut text, comparison);
    }
    if report.verdict == Agreement::Disagree {
        let _ = writeln!(text, "  worst at link {}: {}", report.worst.link, report.worst.at.listed(4));
    }
    for (at, difference) in (1..).zip(&report.at_configurations) {
        let (position, orientation) =
            (length(difference.error.position_m), angle(difference.error.orientation_rad));
        let _ = writeln!(text, "  at configuration {at}: {position} and {orientation}");
    }
    certified(&mut text, report);
    if let Some(ladder) = report.diagnoses.iter().find(|ladder| !ladder.diagnosis.is_empty()) {
        diagnosed(&mut text, ladder);
    }
    text
}

/// What a person tries first.
fn basics(basics: &Basics) -> String {
    let mut text = format!("  the TCP on {}, in the axes of {}:\n", basics.tip, basics.base);
    let width = basics.joints.iter().map(|joint| joint.joint.len()).max().unwrap_or(0);
    by_source(&mut text, &format!("{:width$} {:8}", "at zero", ""), &basics.zero, |pose| {
        let [at, quaternion] = [&pose.translation_m.map(to_mm)[..], &pose.quaternion_wxyz].map(figures);
        format!("at    {at} mm  quaternion {quaternion}")
    });
    for joint in &basics.joints {
        let by = match joint.unit {
            "m" => format!("{:+} mm", to_mm(joint.by)),
            _ => format!("{:+} deg", joint.by.to_degrees().round()),
        };
        by_source(&mut text, &format!("{:width$} {by:>8}", joint.joint), &joint.motion, |motion| {
            let [shift, turn] = [motion.shift_m.map(to_mm), motion.turn_rad.map(f64::to_degrees)];
            format!("shift {} mm  turn {} deg", figures(&shift), figures(&turn))
        });
    }
    let _ = writeln!(
        text,
        "    at all configurations: R'R - I {:.1e}, det R - 1 {:.1e}, T T^-1 off by {:.1e} m and {:.1e} rad",
        basics.orthonormality_error, basics.determinant_error, basics.round_trip_m, basics.round_trip_rad
    );
    text
}

/// One line where table and URDF show the same, otherwise one for each.
fn by_source<T>(text: &mut String, label: &str, by: &BySource<T>, shown: impl Fn(&T) -> String) {
    let lines: Vec<(&str, String)> = by.named().map(|(witness, value)| (witness, shown(value))).collect();
    let lines: &[(&str, String)] = match &lines[..] {
        [(_, table), (_, urdf)] if table == urdf => &[("both", table.clone())],
        lines => lines,
    };
    for (witness, line) in lines {
        let _ = writeln!(text, "    {label} {witness:5}  {line}");
    }
}

/// Three decimals each, and no minus before a zero.
fn figures(figures: &[f64]) -> String {
    let rounded = figures.iter().map(|figure| format!("{:9.3}", (figure * 1e3).round() / 1e3 + 0.0));
    rounded.collect::<Vec<_>>().join(" ")
}

fn to_mm(metres: f64) -> f64 {
    metres * 1e3
}

/// What holds over the whole joint range: a proof, not a sample.
fn certified(text: &mut String, report: &CheckReport) {
    if report.verdict == Agreement::Agree {
        report.certificates.iter().for_each(|certificate| narrow(text, certificate));
        return;
    }
    let mut line = |what: &str, bracket: &ReportedBracket, figure: fn(f64) -> String| {
        let _ = writeln!(
            text,
            "  worst {what} disagreement {} at q = ({}), certified below {} over the whole joint range",
            figure(bracket.attained),
            bracket.at.listed(4),
            figure(bracket.certified)
        );
    };
    if let Some(Brackets { position_m, orientation_rad }) = &report.certificate_bracket {
        line("position", position_m, length);
        line("orientation", orientation_rad, angle);
    }
}

/// A certificate of models that agree, with what it presumes.
fn narrow(text: &mut String, certificate: &ReportedCertificate) {
    let ReportedCertificate { between, brackets, premise, .. } = certificate;
    if let Some(Brackets { position_m, orientation_rad }) = brackets {
        let (position, orientation) = (length(position_m.certified), angle(orientation_rad.certified));
        let _ = writeln!(
            text,
            "  certified: {between} at most {position} and {orientation} apart over the whole joint range"
        );
    }
    if let Some(Premise { configurations, residual_m, residual_rad, holds }) = premise {
        let (kept, figures) =
            (if *holds { "is" } else { "is not" }, [length(*residual_m), angle(*residual_rad)]);
        let _ = writeln!(
            text,
            "    each joint of the physics {kept} one screw, as identified: to {} at {configurations} configurations",
            figures.join(" and ")
        );
    }
}

/// The first cause as a compiler shows it, then what cannot be told from it and what comes next.
fn diagnosed(text: &mut String, ladder: &ReportedDiagnosis) {
    /// Alternatives shown to people; programs get all.
    const SHOWN: usize = 6;
    let _ = writeln!(text, "\n  {}: {}", ladder.title, cause(&ladder.diagnosis[0]));
    for finding in &ladder.findings {
        text.push_str(&rendered(finding));
    }
    if ladder.findings.is_empty() {
        for difference in &ladder.invariants {
            let _ = writeln!(
                text,
                "    {:14} {:24} found {:>12} expected {:>12}",
                difference.invariant,
                difference.joint,
                invariant(difference.invariant, difference.found),
                invariant(difference.invariant, difference.expected)
            );
        }
    }
    for alternative in ladder.indistinguishable.iter().take(SHOWN) {
        let _ = writeln!(text, "  the same: {} ({})", cause(&alternative.cause), alternative.reason);
    }
    if let Some(more) = ladder.indistinguishable.len().checked_sub(SHOWN + 1) {
        let _ = writeln!(text, "  and {} more that leave as little", more + 1);
    }
    for next in &ladder.diagnosis[1..] {
        let _ = writeln!(text, "  next best: {}", cause(next));
    }
}

/// A quantity for people: a kind by its name, and what a chain does not have as such.
fn invariant(name: &str, value: f64) -> String {
    match name {
        _ if value.is_nan() => "none".to_owned(),
        "kind" => if value > 0.0 { "prismatic" } else { "revolute" }.to_owned(),
        _ => format!("{value:.6}"),
    }
}

/// One line for a cause.
fn cause(cause: &ReportedCause) -> String {
    let one = |fault: &Fault| {
        let joints = fault.joint.iter().chain(&fault.joints).cloned().collect::<Vec<_>>().join(", ");
        let words = [fault.cause, fault.parameter.as_deref().unwrap_or_default(), &joints];
        words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
    };
    let what = if cause.parts.is_empty() {
        one(&cause.fault)
    } else {
        cause.parts.iter().map(one).collect::<Vec<_>>().join(" and ")
    };
    format!("{what}, leaves {} and {}", length(cause.residual_m), angle(cause.residual_rad))
}

fn compared(text: &mut String, comparison: &Comparison) {
    let _ = writeln!(
        text,
        "  {:9} {:32} {:>12}  {:>12}  at {}",
        word(comparison.verdict),
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
            PoseSource::DhFitted => "(constant fitted at zero)",
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

fn word(agreement: Agreement) -> &'static str {
    match agreement {
        Agreement::Agree => "agree",
        Agreement::Disagree => "disagree",
    }
}

/// Millimetres where a hand could measure them, otherwise metres with an exponent.
fn length(metres: f64) -> String {
    if metres >= 1e-6 { format!("{:.4} mm", metres * 1e3) } else { format!("{metres:.2e} m") }
}

fn angle(radians: f64) -> String {
    if radians >= 1e-6 { format!("{:.5} deg", radians.to_degrees()) } else { format!("{radians:.2e} rad") }
}
