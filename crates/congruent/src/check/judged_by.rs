//! What decides whether two sources agree, in words: a tolerance that somebody has declared, or the digits that are
//! written.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport, Comparison, Grade},
};
use congruent_description::{RequestedTolerance, Tolerance};
use congruent_input::display::{angle, length, length_and_angle};
use congruent_kinematics::PoseError;

use super::{cause_in_words::largest, robot_check::RobotCheck};

/// If nobody has declared a tolerance, and table and URDF are typed.
const BY_DIGITS: &str = "judged by the digits written (no tolerance declared)";

/// What decides whether poses agree, of table and URDF or of two descriptions.
pub(super) fn poses_judged_by(check: &RobotCheck) -> String {
    if is_by_digits_of_two(check) { BY_DIGITS.to_owned() } else { judged_by(&check.geometry) }
}

/// What decides whether table and URDF agree: the tolerance if one is declared, otherwise the digits of the two, or
/// the rounding of computers if nothing was typed.
pub(super) fn judged_by(report: &CheckReport) -> String {
    if let Some(part) = part_by_digits(report) {
        return part;
    }
    if report.tolerance_is_declared {
        return tolerance_in_words(report);
    }
    if is_by_digits(report) {
        return BY_DIGITS.to_owned();
    }
    "judged by floating-point rounding, since no tolerance is declared".to_owned()
}

/// The same of one comparison: two sources that nobody has typed are compared within a tolerance, declared or not.
pub(super) fn comparison_judged_by(report: &CheckReport, comparison: &Comparison) -> String {
    if comparison.name.is_written() { judged_by(report) } else { tolerance_in_words(report) }
}

/// The tolerance, who gave it, and that of the robot file in whose place it is.
pub(super) fn tolerance_in_words(report: &CheckReport) -> String {
    let Tolerance { position_m, orientation_rad } = report.tolerance;
    let Some(requested) = report.requested_tolerance else {
        return format!("tolerance {}", length_and_angle(position_m, orientation_rad));
    };
    // A part that was not requested is not silently 1e-9.
    let other_part =
        if report.declared_tolerance.is_partial() { "since none is declared" } else { "by the robot file" };
    match (requested.position_m, requested.orientation_rad) {
        (Some(_), None) => {
            let (length, angle) = (length(position_m), angle(orientation_rad));
            format!("tolerance {length} by --tolerance, and for angles {angle} {other_part}")
        }
        (None, Some(_)) => {
            let (length, angle) = (length(position_m), angle(orientation_rad));
            format!("tolerance {angle} by --tolerance, and for lengths {length} {other_part}")
        }
        _ => {
            let replaced = report.replaced_tolerance.map_or_else(String::new, |declared| {
                let declared = length_and_angle(declared.position_m, declared.orientation_rad);
                format!(", the robot file's is {declared}")
            });
            format!("tolerance {} by --tolerance{replaced}", length_and_angle(position_m, orientation_rad))
        }
    }
}

/// Whether the digits of table and URDF decide: nobody has declared a tolerance, and some were typed.
fn is_by_digits(report: &CheckReport) -> bool {
    is_typed(report) && !report.tolerance_is_declared
}

/// Whether the digits of two descriptions decide: no tolerance is declared, and the other is no revision.
fn is_by_digits_of_two(check: &RobotCheck) -> bool {
    let report = &check.geometry;
    let mut pairs = report.comparisons.iter();
    let differ = pairs.any(|of| of.name == SourcePair::UrdfOther && of.verdict == Agreement::Disagree);
    differ && !report.tolerance_is_declared && check.change.is_none()
}

fn is_typed(report: &CheckReport) -> bool {
    report.allowed_by_digits.is_some_and(|allowed| allowed != PoseError::default())
}

/// The tolerance of which one part is declared, if digits decide the other.
fn part_by_digits(report: &CheckReport) -> Option<String> {
    let RequestedTolerance { position_m, orientation_rad } = report.declared_tolerance;
    let (declared, other) = match (position_m, orientation_rad) {
        (Some(position_m), None) => (length(position_m), "angles"),
        (None, Some(orientation_rad)) => (angle(orientation_rad), "lengths"),
        _ => return None,
    };
    let by = if report.requested_tolerance.is_some() { " by --tolerance" } else { "" };
    is_typed(report).then(|| {
        format!(
            "tolerance {declared}{by}, and {other} by the digits written, since none is declared for them"
        )
    })
}

/// What decides, for a page that has the values of the tolerance: the digits, or a tolerance of which one part was requested.
pub(super) fn judged_by_more(check: &RobotCheck) -> Option<String> {
    let report = &check.geometry;
    let is_in_part = report.declared_tolerance.is_partial();
    let words = poses_judged_by(check);
    (is_by_digits_of_two(check) || is_by_digits(report) || is_in_part)
        .then(|| words.trim_start_matches("tolerance ").to_owned())
}

/// What the digits of table and URDF allow, if the two are not identical and not written with all digits.
pub(super) fn allowed(report: &CheckReport) -> String {
    let Some(allowed) = report.allowed_by_digits.filter(|allowed| *allowed != PoseError::default()) else {
        return String::new();
    };
    let PoseError { position_m, orientation_rad } = report.worst.error;
    // All values together may allow more than what was found, and still not this difference. Then their sum is no part of the
    // answer: beside the difference it would look like its explanation.
    let rounding = Tolerance::default();
    let is_less = position_m <= allowed.position_m.max(rounding.position_m)
        && orientation_rad <= allowed.orientation_rad.max(rounding.orientation_rad);
    if is_less && report.grade == Some(Grade::Different) {
        return "; no rounding of the written digits explains it".to_owned();
    }
    format!("; rounding of the written digits could explain {}", largest(allowed))
}

/// A difference without the part that is only the rounding of an `f64`, if the other is more.
pub(super) fn beyond_rounding(error: PoseError) -> String {
    let PoseError { position_m, orientation_rad } = error;
    let same = Tolerance::default();
    match (position_m <= same.position_m, orientation_rad <= same.orientation_rad) {
        (false, true) => length(position_m),
        (true, false) => angle(orientation_rad),
        _ => largest(error),
    }
}
