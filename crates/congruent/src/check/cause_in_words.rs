//! The cause of a difference as one sentence, with its place.

use std::{borrow::Cow, path::Path};

use congruent_agreement::{
    diagnosis::Cause,
    report::{Fault, ReportedCause, ReportedDiagnosis},
};
use congruent_input::{
    Diagnostic,
    display::{counted, length_and_angle, listed},
};
use congruent_kinematics::PoseError;
use congruent_results::report::CasePlace;
use nalgebra::Vector3;

/// Characters of a cause that fit into the first line beside the answer. Kind: choice.
const MOST_OF_A_CAUSE: usize = 180;

pub(super) fn unknown() -> String {
    "No known cause explains it".to_owned()
}

/// The first fault with its place, and how many there are.
pub(super) fn cause(diagnosis: &ReportedDiagnosis) -> String {
    let Some(cause) = diagnosis.named_cause() else { return unknown() };
    let faults = cause.faults();
    let Some(first) = faults.first() else { return unknown() };
    let place = place(first.file.as_deref(), first.line);
    let label = match faults.len() {
        1 => "Cause".to_owned(),
        _ => format!("{} causes", faults.len()),
    };
    // Two are named, so that one line has the places of both.
    let (second, others) = match faults.get(1) {
        Some(second) if faults.len() == 2 => {
            let place = self::place(second.file.as_deref(), second.line);
            (format!("; {}{place}", in_short(second)), 0)
        }
        _ => (String::new(), faults.len() - 1),
    };
    format!("{label}: {}{place}{second}{}{}", in_short(first), and_more(others), unexplained(cause))
}

/// The fault in words; of one with the numbers of whole transforms, which stand below, only by how much they differ.
fn in_short(fault: &Fault) -> Cow<'_, str> {
    let norm = |vector: [f64; 3]| Vector3::from(vector).norm();
    match (&fault.joint, fault.translation_m, fault.rotation_rad) {
        (Some(joint), Some(shift_m), Some(turn_rad))
            if fault.cause == Cause::JointOrigin && fault.message.len() > MOST_OF_A_CAUSE =>
        {
            let off = length_and_angle(norm(shift_m), norm(turn_rad));
            Cow::Owned(format!("joint \"{joint}\": origin off by {off}"))
        }
        _ => Cow::Borrowed(&fault.message),
    }
}

/// The residual of the cause, if that is too much.
fn unexplained(cause: &ReportedCause) -> String {
    if cause.within_tolerance {
        return String::new();
    }
    let residual = PoseError { position_m: cause.residual_m, orientation_rad: cause.residual_rad };
    format!("; that leaves {}", largest(residual))
}

/// How many others there are beside the one that is named.
pub(super) fn and_more(others: usize) -> String {
    if others > 0 { format!(", and {others} more") } else { String::new() }
}

/// As many are named one by one, and more by their number.
pub(super) const MOST_NAMED: usize = 3;

/// A few by name, more by number: `link_1 and link_2`, or `5 links`.
pub(super) fn few_or_number(names: &[String], what: &str) -> String {
    let listed_names: Vec<&str> = names.iter().map(String::as_str).collect();
    if names.len() > MOST_NAMED { counted(names.len(), what) } else { listed(&listed_names) }
}

/// ` (robot.toml:8)`.
pub(super) fn place(file: Option<&str>, line: Option<usize>) -> String {
    let name = file.and_then(|file| Path::new(file).file_name());
    let place = name.zip(line).map(|(name, line)| format!(" ({}:{line})", name.display()));
    place.unwrap_or_default()
}

pub(super) fn largest(error: PoseError) -> String {
    length_and_angle(error.position_m, error.orientation_rad)
}

/// The lines that are wrong, with what is wrong there.
pub(super) fn places(diagnosis: &ReportedDiagnosis) -> Vec<(CasePlace, String)> {
    let place = |finding: &Diagnostic| {
        let (line, _) = finding.line_column()?;
        let place = CasePlace::if_known(finding.source.as_ref()?.path.to_str(), Some(line))?;
        Some((place, finding.message.clone()))
    };
    diagnosis.findings.iter().filter_map(place).collect()
}

/// That no joint is off, if links move alike in both descriptions and their frames lie elsewhere in them.
pub(super) fn frames_elsewhere(links: &[String]) -> Option<String> {
    let (first, more) = (links.first()?, and_more(links.len() - 1));
    Some(format!("No joint is off: the frame of {first} lies elsewhere in its link{more}"))
}

/// A bound in words: `at most 0.8 pm`, or `<1 pm`.
pub(super) fn at_most(bound: PoseError) -> String {
    let bound = largest(bound);
    if bound.starts_with('<') { bound } else { format!("at most {bound}") }
}
