//! The dynamics of `congruent check` as text for people: one line if two sources agree; otherwise the cause with its lines
//! of the file, what else would have the same torques, what no torque depends on, and how large the differences get.

use std::fmt::Write;

use crate::{
    OtherDescription, RobotCheck,
    agreement::{
        SourcePair,
        compare::Agreement,
        diagnosis::Cause,
        report::{ReportedCause, ReportedDiagnosis},
    },
    description::{JointValues, Robot, RobotQ},
    dynamics_agreement::{
        DynamicsExplanation, DynamicsReport, DynamicsVerdict, LimitDifference, ParameterDifference,
        TorqueBracket,
    },
    input::display::{counted, first_of},
};

use congruent_text::layout::wrapped;

/// Parameters, alternatives or hidden differences that are shown to people; JSON has all of them.
const SHOWN: usize = 8;

/// All comparisons of dynamics of a check.
pub(super) fn dynamics(text: &mut String, check: &RobotCheck, robot: &Robot) {
    if let Some(against) = &check.against {
        not_compared(text, check, against);
        as_compared(text, check, against);
    }
    let disagrees = |report: &&DynamicsReport| !report.agrees();
    let files = |report| check.files_of(report);
    check.dynamics_of_descriptions().for_each(|report| compared(text, report, files(report), robot));
    // Of the physics only what is wrong.
    check
        .dynamics_of_physics()
        .filter(disagrees)
        .into_iter()
        .for_each(|report| compared(text, report, None, robot));
    within_digits(
        text,
        check.declared_dynamics.as_ref().map_or(&[], |declared| &declared.values_within_digits),
    );
    let declared = check.declared_dynamics.as_ref().map(|declared| &declared.not_declared);
    if let Some(left_out) = declared.filter(|left_out| !left_out.is_empty()) {
        let _ =
            writeln!(text, "  not compared, since the robot file does not state it: {}", left_out.join("; "));
    }
}

fn within_digits(text: &mut String, values: &[String]) {
    if !values.is_empty() {
        let _ = writeln!(
            text,
            "  rounded: {} of masses, inertias, limits and losses are equal within the digits written: {}",
            counted(values.len(), "value"),
            first_of(values, SHOWN)
        );
    }
}

/// What is not compared with the other description, and why.
fn not_compared(text: &mut String, check: &RobotCheck, against: &OtherDescription) {
    if let Some(why) = &against.dynamics_not_compared {
        let has_poses = check.geometry.comparisons.iter().any(|of| of.name == SourcePair::UrdfOther);
        let has_masses = check.dynamics_of_descriptions().next().is_some();
        let what = match (has_poses, has_masses) {
            (true, true) => "centres of mass and inertias",
            (true, false) => "dynamics",
            (false, _) => "poses and dynamics",
        };
        let _ = writeln!(text, "  not compared with the other description: {what}: {why}");
    }
    let joints = &against.joints_left_out;
    if !joints.is_empty() {
        let _ = writeln!(
            text,
            "  not compared with the other description, since they do not move the tip that --tip names: {}, and what \
             they carry",
            joints.join(", ")
        );
    }
    let links = &against.links_not_found;
    if !links.is_empty() {
        let _ =
            writeln!(text, "  not compared: links that the other description lacks: {}", links.join(", "));
    }
}

/// How masses, inertias and losses of the two are compared where that is not plain.
fn as_compared(text: &mut String, check: &RobotCheck, against: &OtherDescription) {
    let links = &against.links_in_other_frames;
    if !links.is_empty() {
        let _ = writeln!(
            text,
            "  the frames of {} are placed differently in their links in the other description, but the joints \
             move the links alike: dynamics is compared in the frames of this description",
            links.join(", ")
        );
    }
    let links = &against.fused_links;
    if !links.is_empty() {
        let _ = writeln!(
            text,
            "  links that are fixed to each other are compared as one body: {}",
            first_of(links, SHOWN)
        );
    }
    within_digits(text, &against.values_within_digits);
    let mut pairs = check.geometry.comparisons.iter().filter(|of| of.name == SourcePair::UrdfOther);
    let is_compared =
        check.dynamics_of_descriptions().next().is_some() && against.links_in_other_frames.is_empty();
    if is_compared && pairs.any(|of| of.verdict == Agreement::Disagree) {
        text.push_str(
            "  the poses differ, so torques are computed with the geometry of this file for both: only masses and losses count in them\n",
        );
    }
    let causes = check.geometry.diagnoses.iter().filter_map(ReportedDiagnosis::named_cause);
    let mut faults = causes.flat_map(ReportedCause::faults);
    if faults.any(|fault| fault.cause == Cause::Mimic) {
        text.push_str(
            "  torques are compared with every follower (<mimic>) as a joint of its own, since followers of the two files differ\n",
        );
    }
}

/// One comparison; `files` are its two files, if neither is known to be right.
fn compared(text: &mut String, report: &DynamicsReport, files: Option<[&str; 2]>, robot: &Robot) {
    let verdict = match (report.has_same_torques(), report.verdict) {
        (_, DynamicsVerdict::NotCompared) => "not compared:",
        (true, _) => "agree",
        (false, _) => "disagree",
    };
    let (candidate, reference) = (&report.sides.candidate, &report.sides.reference);
    let _ =
        writeln!(text, "  {verdict:9} dynamics of {candidate} against {reference}: {}", report.headline());
    for explanation in &report.explanations {
        explained(text, explanation, files);
    }
    if report.explanations.is_empty() && !report.has_same_torques() {
        for difference in report.differences.iter().take(SHOWN) {
            let file = Some(report.sides.candidate.as_str());
            let _ = writeln!(text, "      {}", placed(difference, file, files));
        }
        if let Some(more) = more(report.differences.len(), "parameters") {
            let _ = writeln!(text, "      {more}");
        }
    }
    let mut lines = Vec::new();
    lines.extend(report.not_stated_sentence());
    if !report.has_other_limits() {
        lines.extend(limits(report, files));
    }
    if !report.has_same_torques() {
        let others: Vec<&DynamicsExplanation> = report
            .indistinguishable
            .iter()
            .filter(|other| !other.contradicted)
            .filter(|other| !report.explanations.iter().any(|first| has_parts_of(first, other)))
            .collect();
        for other in others.iter().take(SHOWN) {
            let reason = other.reason.map_or_else(String::new, |reason| format!(" ({})", reason.text()));
            lines.push(format!("indistinguishable: {}{reason}", other.sentence()));
        }
        lines.extend(more(others.len(), "causes that cannot be distinguished"));
        lines.extend(report.invariant_sentences());
    }
    lines.extend(report.hidden_sentences(files).into_iter().take(SHOWN));
    lines.extend(more(report.hidden_differences.len(), "differences that change no joint torque"));
    for line in lines {
        let _ = writeln!(text, "    {line}");
    }
    largest(text, report, robot);
    if report.has_other_limits() {
        let _ = writeln!(text, "  disagree  joint limits of {candidate} against {reference}:");
        for line in limits(report, files) {
            let _ = writeln!(text, "    {line}");
        }
    }
    // Below what disagrees, and no part of it.
    for line in report.armature_sentence().into_iter().chain(report.one_sided_limit_sentences()) {
        let _ = writeln!(text, "  {line}");
    }
}

/// The largest torque differences, each with the configuration that has it.
fn largest(text: &mut String, report: &DynamicsReport, robot: &Robot) {
    if let Some(worst) = report.worst_gravity() {
        certified(text, "gravity torque difference", worst, robot);
    }
    if let (Some(worst), Some(all)) = (report.worst_in_motion(), &report.certificates) {
        certified(text, "torque difference in motion", worst, robot);
        let _ = writeln!(text, "      {}", all.covered_sentence());
    }
}

/// Whether two explanations of several faults name the same faults, whatever their order and the last digits.
fn has_parts_of(one: &DynamicsExplanation, other: &DynamicsExplanation) -> bool {
    let is_same = one.parts.len() == other.parts.len() && !one.parts.is_empty();
    is_same && one.parts.iter().all(|part| other.parts.contains(part))
}

fn more(all: usize, what: &str) -> Option<String> {
    match all.checked_sub(SHOWN)? {
        0 => None,
        1 => Some("and one more".to_owned()),
        more => Some(format!("and {more} more {what}")),
    }
}

/// Whether two values are one that was typed with fewer digits in one of the files.
fn is_rounded(parameter: &ParameterDifference) -> bool {
    /// Six significant digits, of which the last is rounded. No unit, relative; kind: choice.
    const ROUNDED: f64 = 5e-6;
    parameter
        .found
        .zip(parameter.expected)
        .is_some_and(|(a, b)| (a - b).abs() <= ROUNDED * a.abs().max(b.abs()))
}

/// A cause, its parameters with the lines that say them, and what to write.
fn explained(text: &mut String, explanation: &DynamicsExplanation, files: Option<[&str; 2]>) {
    let _ = writeln!(text, "    {}", explanation.sentence());
    let (rounded, off): (Vec<_>, Vec<_>) =
        explanation.parameters.iter().partition(|parameter| is_rounded(parameter));
    // If nothing else differs, rounding is the cause.
    let (listed, rounded) = if off.is_empty() { (rounded, 0) } else { (off, rounded.len()) };
    for parameter in listed.iter().take(SHOWN) {
        let remark = parameter.unit_remark().filter(|_| explanation.cause.is_of_free_values());
        let remark = remark.map_or_else(String::new, |remark| format!(": {remark}"));
        let line = placed(parameter, explanation.file.as_deref(), files);
        let _ = writeln!(text, "      {line}{remark}");
    }
    if let Some(more) = more(listed.len(), "parameters") {
        let _ = writeln!(text, "      {more}");
    }
    if rounded > 0 {
        let _ = writeln!(text, "      and {} by rounding alone", counted(rounded, "difference"));
    }
    for law in &explanation.impossible_as_written {
        let _ = writeln!(text, "      as written, the inertia is physically impossible: {law}");
    }
    if let Some(law) = &explanation.body_law {
        let _ = writeln!(text, "      corrected, the inertia is still physically impossible: {law}");
    }
    if let Some(otherwise) = &explanation.otherwise {
        let _ = writeln!(text, "      or the other file is wrong: {otherwise}");
    }
    if let Some(advice) = explanation.suggestion.as_ref().filter(|_| explanation.cause.is_of_one_file()) {
        let _ = writeln!(text, "      {advice}");
    }
    if explanation.changes.is_empty() {
        return;
    }
    // The value to write here would be the wrong one.
    let is_other_wrong = |parameter: &&&ParameterDifference| parameter.is_reference_in_other_unit();
    if let Some(([_, other], wrong)) = files.zip(listed.iter().find(is_other_wrong)) {
        let line = wrong.expected_line.map_or_else(String::new, |line| format!(":{line}"));
        let _ = writeln!(text, "      to correct in {other}{line}: the unit of {}", wrong.parameter);
        return;
    }
    let _ = writeln!(text, "      to write in {}:", explanation.file.as_deref().unwrap_or("the file"));
    for change in &explanation.changes {
        let _ = writeln!(text, "      line {}:", change.from_line);
        for line in change.text.lines() {
            let _ = writeln!(text, "        {}", line.trim_start());
        }
    }
}

/// A parameter that differs, with its place in the file to correct, or with those in both files.
fn placed(parameter: &ParameterDifference, file: Option<&str>, files: Option<[&str; 2]>) -> String {
    match (files, file, parameter.line) {
        (Some(files), ..) => parameter.sentence_in(files),
        (None, Some(file), Some(line)) => format!("{file}:{line}: {}", parameter.sentence()),
        _ => parameter.sentence(),
    }
}

/// The limits that disagree with the lines that say them, each joint with what to write once.
fn limits(report: &DynamicsReport, files: Option<[&str; 2]>) -> Vec<String> {
    let mut lines = Vec::new();
    let differences: Vec<&LimitDifference> = report.limits.iter().filter(|limit| limit.decides).collect();
    for (at, difference) in differences.iter().enumerate() {
        lines.push(match (files, &difference.file, difference.line) {
            (Some(files), ..) => difference.sentence_in(files),
            (None, Some(file), Some(line)) => format!("{file}:{line}: {}", difference.sentence()),
            _ => difference.sentence(),
        });
        if differences.get(at + 1).is_some_and(|next| next.changes == difference.changes) {
            continue;
        }
        for change in &difference.changes {
            let file = difference.file.as_ref().map_or_else(String::new, |file| format!("{file}, "));
            lines.push(format!("  to write in {file}line {}:", change.from_line));
            lines.extend(change.text.lines().map(|line| format!("    {}", line.trim_start())));
        }
    }
    lines
}

/// The largest difference of a torque, with the configuration that has it.
fn certified(text: &mut String, what: &str, worst: &TorqueBracket, robot: &Robot) {
    let _ = writeln!(text, "    largest {what} {}, at", worst.sentence());
    let at = JointValues::for_movable_joints(robot, &RobotQ::from(worst.q.clone()));
    text.push_str(&wrapped(&at.for_people(robot)));
}
