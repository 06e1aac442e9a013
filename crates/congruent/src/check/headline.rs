//! The first line of a check: the answer in the words of the question, what was compared, and the largest difference.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckReport, Comparison, Grade, WorstDifference},
};
use congruent_description::{Tolerance, codes::chain::TABLE_DROPPED};
use congruent_dynamics_agreement::{DynamicsReport, DynamicsVerdict};
use congruent_input::display::{length_and_angle, listed};
use congruent_kinematics::PoseError;

use super::{against::OtherDescription, robot_check::RobotCheck};

impl RobotCheck {
    /// The answer as `check` and its page give it: whether the descriptions are the same robot, by which sources, and how
    /// far they differ; and what the robot file declares of another chain, which the answer does not cover.
    pub fn headline(&self) -> String {
        let mut warnings = self.geometry.warnings.iter();
        let dropped = warnings.find(|warning| warning.code == TABLE_DROPPED.name);
        let dropped = dropped.map_or_else(String::new, |warning| format!("; {}", warning.message));
        self.answer() + &dropped
    }

    fn answer(&self) -> String {
        let report = &self.geometry;
        if let Some((other, why)) = other_chain(self) {
            let other = &other.file;
            return format!("not the same robot as {other}: another chain, {why}; the two were not compared");
        }
        if report.verdict == Agreement::NothingCompared {
            return format!("nothing was compared: {}", Agreement::why_nothing(&report.chain));
        }
        let is_same_within_digits = report.grade == Some(Grade::SameWithinDigits);
        let (answer, found) = if report.poses_disagree() {
            let answer = if is_same_within_digits {
                "the same within the digits written, but not within the tolerance"
            } else {
                "not the same robot"
            };
            (answer, differing(report).join(", "))
        } else if is_same_within_digits && report.is_judged_by_digits() {
            let worst = difference(&report.worst);
            let found = format!("DH table against URDF: up to {worst}{}", allowed(report));
            let answer =
                answer_of_agreeing_poses(self).replace("same robot", "same robot within the digits written");
            return format!(
                "{answer}. {found} (no tolerance declared, {} configurations)",
                report.configurations
            );
        } else {
            // The largest difference of sources that agree is rounding, and its place means nothing.
            let found = format!("{} agree within {}", listed(&agreeing(report)), difference(&report.worst));
            (answer_of_agreeing_poses(self), found)
        };
        format!("{answer}. {found} ({}, {} configurations)", tolerance(report), report.configurations)
    }
}

/// The answer if no pose differs. Physics and screws are made of the URDF, so that they are no second description of it.
fn answer_of_agreeing_poses(check: &RobotCheck) -> &'static str {
    let report = &check.geometry;
    let has_second_geometry = report.table_compared || check.against.is_some();
    let reports = || check.all_dynamics();
    let differ_in_limits_alone = reports().all(DynamicsReport::has_same_torques)
        && reports().any(DynamicsReport::has_other_limits)
        && check.against.as_ref().is_none_or(|other| other.dynamics_not_compared.is_none());
    if report.verdict == Agreement::Disagree && differ_in_limits_alone {
        return "same geometry and dynamics, different joint limits";
    }
    let has_masses_of_both = reports().all(|of| of.verdict != DynamicsVerdict::NotCompared);
    match (report.verdict, has_second_geometry, &check.declared_dynamics) {
        (Agreement::Agree, true, None) if !has_masses_of_both => "same geometry, masses not compared",
        (Agreement::Disagree, true, _) => "same geometry, different dynamics",
        (Agreement::Disagree, false, _) => "different dynamics",
        (_, true, _) => "same robot",
        (_, false, Some(_)) => "same dynamics, no second geometry was compared",
        (_, false, None) => "no second description was compared",
    }
}

/// The largest distance and angle.
fn difference(worst: &WorstDifference) -> String {
    length_and_angle(worst.error.position_m, worst.error.orientation_rad)
}

/// The tolerance, and that of the robot file if another one was requested.
fn tolerance(report: &CheckReport) -> String {
    let words = |tolerance: &Tolerance| length_and_angle(tolerance.position_m, tolerance.orientation_rad);
    let replaced = report.replaced_tolerance.as_ref().map_or_else(String::new, |declared| {
        format!(" by --tolerance, the robot file's is {}", words(declared))
    });
    format!("tolerance {}{replaced}", words(&report.tolerance))
}

/// Why nothing of two descriptions was compared: they have other joints.
fn other_chain(check: &RobotCheck) -> Option<(&OtherDescription, &str)> {
    let against = check.against.as_ref()?;
    let mut compared = check.geometry.comparisons.iter().map(|of| of.name);
    let why = against.dynamics_not_compared.as_ref()?;
    (!compared.any(|name| name == SourcePair::UrdfOther)).then_some((against, why))
}

/// What the digits of table and URDF allow, if the two are not identical and not written with all digits.
fn allowed(report: &CheckReport) -> String {
    let Some(allowed) = report.allowed_by_digits.filter(|allowed| *allowed != PoseError::default()) else {
        return String::new();
    };
    let words = length_and_angle(allowed.position_m, allowed.orientation_rad);
    let PoseError { position_m, orientation_rad } = report.worst.error;
    // All values together may allow more than what was found, and still not this difference.
    let rounding = Tolerance::default();
    let is_less = position_m <= allowed.position_m.max(rounding.position_m)
        && orientation_rad <= allowed.orientation_rad.max(rounding.orientation_rad);
    let but = if is_less && report.grade == Some(Grade::Different) {
        ", but no rounding gives this one"
    } else {
        ""
    };
    format!(", where the digits written allow {words}{but}")
}

/// The two sources of a pair.
fn sources(pair: SourcePair) -> [&'static str; 2] {
    match pair {
        SourcePair::ModelUrdf => ["DH table", "URDF"],
        SourcePair::PoeUrdf => ["screws", "URDF"],
        SourcePair::ModelSimulation => ["DH table", "physics"],
        SourcePair::UrdfSimulation => ["URDF", "physics"],
        SourcePair::UrdfOther => ["URDF", "other URDF"],
    }
}

/// The sources that were compared: descriptions first, then what was made of them.
fn agreeing(report: &CheckReport) -> Vec<&'static str> {
    let compared: Vec<&str> =
        report.comparisons.iter().flat_map(|comparison| sources(comparison.name)).collect();
    ["DH table", "URDF", "other URDF", "screws", "physics"]
        .into_iter()
        .filter(|source| compared.contains(source))
        .collect()
}

/// The pairs that differ, each with its largest difference and the link that has it.
fn differing(report: &CheckReport) -> Vec<String> {
    let differ = report.comparisons.iter().filter(|comparison| comparison.verdict == Agreement::Disagree);
    let words = |comparison: &Comparison| {
        let [a, b] = sources(comparison.name);
        let allowed = if comparison.name == SourcePair::ModelUrdf { allowed(report) } else { String::new() };
        format!(
            "{a} against {b}: up to {} at {}{allowed}",
            difference(&comparison.worst),
            comparison.worst.link
        )
    };
    differ.map(words).collect()
}
