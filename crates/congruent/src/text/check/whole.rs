//! The report of `congruent check` as text for people.

use std::{
    fmt::Write,
    iter::{empty, once, once_with},
};

use congruent_text::{
    TextOptions,
    layout::{column_width, with_one_sign, wrapped},
};

use crate::{
    LintSummary, RobotCheck, WrittenFix,
    agreement::{
        SourcePair,
        compare::{
            Agreement, Basics, Brackets, BySource, CheckReport, ComparedSource, Comparison, CoordinateUnit,
            Grade, LinkDifference, NotCompared, PoseSource, Premise, ReportedBracket, ReportedCertificate,
        },
    },
    check::in_words_of,
    description::{Robot, Tolerance},
    input::{
        Finding,
        display::{angle, counted, length, length_and_angle, number},
    },
    kinematics::PoseError,
};

use super::{
    diagnosis::{diagnosed, rounded},
    dynamics::dynamics,
    errors_at::{lines, table},
    mapping::mapped,
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
/// assert!(printed.starts_with(&format!("{}: SAME GEOMETRY", report.geometry.file)));
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
    let in_words = |text: String| in_words_of(check.loaded(), text);
    let last = once_with(move || in_words(last_text(check, robot, options)) + &basics);
    once(in_words(answer_text(check, robot, options))).chain(at_configurations).chain(last)
}

/// The answer, its cause, and the comparisons of poses: what is before the errors at requested configurations.
fn answer_text(check: &RobotCheck, robot: &Robot, options: &TextOptions) -> String {
    let report = &check.geometry;
    let mut text = String::new();
    let _ = writeln!(text, "{}: {}", report.file, check.headline());
    let _ = writeln!(text, "  {}: {}", report.robot, report.chain);
    let mapping = check.against.as_ref().and_then(|of| Some((of, of.mapping.as_ref()?)));
    if let Some((against, mapping)) = mapping {
        mapped(&mut text, mapping, &against.file);
    }
    if let Some(diagnosis) = check.diagnosis() {
        diagnosed(&mut text, diagnosis, &report.tolerance, options);
    }
    if report.poses_disagree() && report.grade == Some(Grade::SameWithinDigits) {
        rounded(&mut text, report);
    }
    if mapping.is_some_and(|(_, mapping)| !mapping.is_declared) && check.diagnosis().is_none() {
        text.push('\n');
    }
    poses(&mut text, report, options);
    certified(&mut text, report, robot, options);
    text
}

/// What follows: the dynamics, what was not compared, what lint finds, and the corrected table.
fn last_text(check: &RobotCheck, robot: &Robot, options: &TextOptions) -> String {
    let mut text = String::new();
    dynamics(&mut text, check, robot);
    physics(&mut text, check, options);
    not_compared(&mut text, &check.geometry);
    linted(&mut text, check);
    if let Some(corrected) = check.diagnosis().and_then(|diagnosis| diagnosis.corrected.as_ref()) {
        let _ = writeln!(text, "\n  the table of {}, corrected:\n\n{}", corrected.file, corrected.table());
    }
    if let Some(fix) = &check.fix {
        fixed(&mut text, fix);
    }
    text
}

/// Whether a comparison shows only that the program has read the URDF right.
fn is_of_urdf_alone(comparison: &Comparison) -> bool {
    matches!(comparison.name, SourcePair::PoeUrdf | SourcePair::UrdfSimulation)
}

/// The comparisons of poses: those of two descriptions, and every one that disagrees.
fn poses(text: &mut String, report: &CheckReport, options: &TextOptions) {
    let is_shown =
        |of: &&Comparison| options.is_in_full || !is_of_urdf_alone(of) || of.verdict == Agreement::Disagree;
    for comparison in report.comparisons.iter().filter(is_shown) {
        compared(text, comparison, &report.tolerance, options);
    }
}

/// That the physics is the URDF: no second description, so that a line says it.
fn physics(text: &mut String, check: &RobotCheck, options: &TextOptions) {
    let mut poses = check.geometry.comparisons.iter().filter(|of| of.name == SourcePair::UrdfSimulation);
    let is_built = poses.next().is_some_and(|of| of.verdict == Agreement::Agree);
    let torques = check.dynamics_of_physics();
    let what = match torques {
        Some(report) if report.has_same_torques() => "poses and torques",
        _ => "poses",
    };
    if is_built {
        let title = check.geometry.title(SourcePair::UrdfSimulation);
        let source = title.split_once(" chain").map_or(title, |(source, _)| source);
        let _ = writeln!(text, "  the physics is that of the {source} in {what}");
    }
    if let Some(report) = torques.filter(|_| options.is_in_full) {
        let _ = writeln!(
            text,
            "    torques of the two differ by {} (relative); {}",
            number(report.difference_relative),
            report.headline()
        );
    }
}

/// What has no second source, or could not be compared with it, and why.
fn not_compared(text: &mut String, report: &CheckReport) {
    for NotCompared { source, findings } in &report.not_asked {
        let what = match source {
            ComparedSource::Simulation => "physics",
            ComparedSource::SimulatedDynamics => "torques of the physics",
            ComparedSource::OtherDynamics => "torques of the other description",
            ComparedSource::DeclaredDynamics => "[[inertial]]",
            ComparedSource::Geometry => "geometry",
            ComparedSource::Dynamics => "dynamics",
        };
        for finding in findings {
            let _ = writeln!(text, "  not compared: {what}: {}", finding.message);
        }
    }
}

/// What lint finds in the descriptions: how much, and the worst.
fn linted(text: &mut String, check: &RobotCheck) {
    let LintSummary { errors, warnings, worst, for_clearance, .. } = &check.lint;
    counted_findings(text, [*errors, *warnings], worst);
    if let [first, rest @ ..] = &for_clearance[..] {
        let more = if rest.is_empty() { String::new() } else { format!(" (and {} more)", rest.len()) };
        let message = clipped(&first.message);
        let _ = writeln!(text, "  not needed for this check: {message}{more}");
    }
}

/// The counts of errors and warnings, and the worst of these findings.
fn counted_findings(text: &mut String, [errors, warnings]: [usize; 2], worst: &[Finding]) {
    let counts = [(errors, "error"), (warnings, "warning")].into_iter().filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, what)| counted(count, what)).collect();
    if counts.is_empty() {
        let _ = writeln!(text, "  lint: no findings");
        return;
    }
    let listed = if errors + warnings > worst.len() { ", the worst" } else { "" };
    let _ = writeln!(text, "  lint: {}{listed} (in full: `congruent lint`):", counts.join(" and "));
    for Finding { file, line, message, .. } in worst {
        let place = match (file, line) {
            (Some(file), Some(line)) => format!("{file}:{line}: "),
            (Some(file), None) => format!("{file}: "),
            (None, _) => String::new(),
        };
        let _ = writeln!(text, "    {place}{}", clipped(message));
    }
}

/// The beginning of a message that would fill the terminal.
fn clipped(message: &str) -> String {
    /// Longest message of a list. Kind: choice; two lines of a terminal.
    const LONGEST: usize = 160;
    match message.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} ...", message[..end].trim_end()),
        None => message.to_owned(),
    }
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

/// The certificate: a bound over the whole joint range, not a sample. If all agree, the first line has it.
fn certified(text: &mut String, report: &CheckReport, robot: &Robot, options: &TextOptions) {
    if !report.poses_disagree() {
        let unproved = |of: &&ReportedCertificate| {
            let fails = of.premise.as_ref().is_some_and(|it| !it.holds);
            options.is_in_full || fails || of.unranged.is_some()
        };
        report.certificates.iter().filter(unproved).for_each(|certificate| narrow(text, certificate));
        return;
    }
    let Some(Brackets { position_m, orientation_rad }) = &report.certificate_bracket else {
        let _ = writeln!(text, "  largest difference at link {}, at", report.worst.link);
        *text += &wrapped(&report.worst.at.for_people(robot));
        if !report.worst.at_in_other.is_empty() {
            let _ =
                writeln!(text, "    and in the other file {}", report.worst.at_in_other.for_people(robot));
        }
        return;
    };
    let mut line = |what: &str, bracket: &ReportedBracket, most: f64, shown: fn(f64) -> String| {
        if bracket.certified <= most {
            return;
        }
        let _ = writeln!(
            text,
            "  over the whole joint range the {what} difference is at most {} (certified); largest found {}, at",
            shown(bracket.certified),
            shown(bracket.attained)
        );
        *text += &wrapped(&bracket.at.for_people(robot));
    };
    line("position", position_m, report.tolerance.position_m, length);
    line("orientation", orientation_rad, report.tolerance.orientation_rad, angle);
}

/// The certificate of models that agree, with its premise.
fn narrow(text: &mut String, certificate: &ReportedCertificate) {
    let ReportedCertificate { name, title, brackets, premise, unranged } = certificate;
    if let Some(joint) = unranged {
        let _ = writeln!(text, "  not certified  {title}: joint {joint} slides without a range");
    }
    if let Some(brackets) = brackets {
        let PoseError { position_m, orientation_rad } = brackets.bounds();
        let bound = length_and_angle(position_m, orientation_rad);
        let _ = writeln!(text, "  certified  {title:32} at most {bound} over the whole joint range");
    }
    if let Some(Premise { configurations, residual_m, residual_rad, holds }) = premise {
        let verified = if *holds { "verified as" } else { "are not" };
        let whose = if *name == SourcePair::UrdfOther { "the other description's" } else { "simulated" };
        let residual = length_and_angle(*residual_m, *residual_rad);
        let _ = writeln!(
            text,
            "    {whose} joints {verified} pure screw motions: residual {residual} at {configurations} configurations"
        );
    }
}

/// A comparison in a row; if the two disagree, with the links that show it.
fn compared(text: &mut String, comparison: &Comparison, tolerance: &Tolerance, options: &TextOptions) {
    let Comparison { verdict, title, worst, links, .. } = comparison;
    let disagrees = *verdict == Agreement::Disagree;
    let at = if disagrees { format!("  at {}", worst.link) } else { String::new() };
    let [position, orientation] = errors(&worst.error, tolerance);
    let _ = writeln!(text, "  {verdict:9} {title:32} {position:>12}  {orientation:>12}{at}");
    if !disagrees {
        return;
    }
    let is_worst = |link: &LinkDifference| link.link == worst.link && link.error == worst.error;
    let is_shown = |link: &&LinkDifference| {
        let decides = link.source != PoseSource::DhFitted;
        options.is_in_full || (decides && !is_worst(link) && !link.error.is_within(tolerance))
    };
    for link in links.iter().filter(is_shown) {
        let [position, orientation] = errors(&link.error, tolerance);
        let fitted = match link.source {
            PoseSource::DhFitted => "  (the table does not define this frame: for information only)",
            _ => "",
        };
        let _ = writeln!(text, "            {:32} {position:>12}  {orientation:>12}{fitted}", link.link);
    }
}

/// Both parts of a difference; what is within the tolerance is not worth a number.
fn errors(error: &PoseError, tolerance: &Tolerance) -> [String; 2] {
    let shown = |value: f64, most: f64, shown: fn(f64) -> String| {
        if value <= most { format!("<{}", shown(most)) } else { shown(value) }
    };
    [
        shown(error.position_m, tolerance.position_m, length),
        shown(error.orientation_rad, tolerance.orientation_rad, angle),
    ]
}
