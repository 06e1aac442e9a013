//! The report of a check as its page shows it.

use congruent_agreement::SourcePair;
use congruent_description::RobotDescription;
use congruent_page::CheckedRobot;

use super::{headline::Headline, judged_by::judged_by_more, robot_check::RobotCheck};

/// The report on a robot for [`check_page`](congruent_page::check_page), with the descriptions that it is about.
pub fn checked_robot<'a>(
    report: &'a RobotCheck,
    description: &'a RobotDescription,
    other: Option<&'a RobotDescription>,
) -> CheckedRobot<'a> {
    let mut not_compared = Vec::new();
    if let Some(why) = report.against.as_ref().and_then(|against| against.dynamics_not_compared.as_ref()) {
        let mut compared = report.geometry.comparisons.iter();
        let has_poses = compared.any(|of| of.name == SourcePair::UrdfOther);
        let what = if has_poses { "dynamics is" } else { "poses and dynamics are" };
        not_compared.push(format!("with the other description, {what} not compared: {why}"));
    }
    let declared = report.declared_dynamics.as_ref().map(|declared| declared.not_declared.join("; "));
    not_compared.extend(
        declared
            .filter(|left_out| !left_out.is_empty())
            .map(|left_out| format!("not compared (no [[inertial]] entry): {left_out}")),
    );
    let mut findings = report.geometry.warnings.clone();
    let further = report.lint.worst.iter().filter(|found| !report.geometry.warnings.contains(found));
    findings.extend(further.cloned());
    if let Some(mapping) = report.against.as_ref().and_then(|against| against.mapping.as_ref()) {
        let left_out = [&mapping.left_out[..], &mapping.other_left_out].concat();
        if !left_out.is_empty() {
            let joints = left_out.join(", ");
            not_compared
                .push(format!("joints that move in one description alone, with what they carry: {joints}"));
        }
    }
    let Headline { answer, details } = report.headline();
    let (description, other) = match report.mapped.as_deref() {
        Some([own, there]) => (own, Some(there)),
        None => (description, other),
    };
    CheckedRobot {
        answer,
        details,
        judged_by: judged_by_more(report),
        findings,
        description,
        geometry: &report.geometry,
        at_configurations: report.at_configurations.as_ref(),
        other,
        dynamics: report.all_dynamics().collect(),
        not_compared,
    }
}
