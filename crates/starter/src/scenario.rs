//! `congruent new scenario`: a scenario that passes, found by trying it.

use std::path::{Path, PathBuf};

use congruent_agreement::compare::{CheckOptions, check};
use congruent_description::{ReportedChain, RobotDescription, Tolerance};
use congruent_input::{
    Capability, Diagnostic, Finding, Findings,
    display::{length_and_angle, quantity},
};
use congruent_monitors::verdict::{CheckResult, Status};
use congruent_results::report::lines;
use congruent_scenario::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ContactCheck, ControllerSettings, OnViolation, Scenario,
};
use congruent_twin::source::SimulatedPoses;
use congruent_writers::relative_path;
use schemars::JsonSchema;
use serde::Serialize;

use crate::codes;
use crate::{
    joint_move::{JointMove, moves},
    scenario_text::{ScenarioContent, text},
    settings::{checks, computed_torque, gravity_compensation, start_settings},
    touching::{FarthestMove, PairDistances},
    trial::{MotionAttempt, PLAYBACK, SIZES, Trial, is_optional},
    written::absolute,
};

/// Distance that links must keep at least, or half of the smallest distance of the motion if that is less. Unit: m.
const MOST_MINIMUM_M: f64 = 0.02;

/// A scenario that has passed, and its text.
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioDraft {
    /// The text of the file.
    pub text: String,
    /// The links that come nearest to each other, and what was left out with the reason.
    pub remarks: Vec<String>,
    /// Names of the joints that move, in the order of the robot.
    pub joints: Vec<String>,
}

/// The answer of `congruent new scenario`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NewScenario {
    /// The scenario file that was written.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// Names of the joints that move, in the order of the robot.
    pub joints: Vec<String>,
    /// Kind of the controller.
    pub controller: String,
    /// Simulated duration of the scenario. Unit: s.
    pub duration_s: f64,
    /// Checks that are omitted, and why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// The checks of the written file, which was run.
    pub checks: Vec<CheckResult>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// A scenario for the chain of `description`, to be written to `file`, an absolute path: some joints move and come back,
/// links stay apart, and all checks pass.
///
/// # Errors
/// What keeps the robot from being simulated, or from passing.
pub fn scenario(description: &RobotDescription, file: &Path) -> Result<ScenarioDraft, Findings> {
    description.check_capability(Capability::Physics)?;
    let (mut content, largest) = content(description, file)?;
    if let Some((agreement, remark)) = within_digits(description) {
        content.scenario.check.retain(|check| check.kind() != CheckKind::Agreement);
        content.scenario.check.insert(0, Check::Agreement(agreement));
        content.remarks.push(remark);
    }
    let mut last = String::new();
    // With forces first, and the largest motion first: the more of the robot a scenario exercises, the more it
    // checks. Playback always remains.
    let forces = [computed_torque(), gravity_compensation()].map(|controller| (controller, &SIZES[..]));
    let playback = (ControllerSettings::default(), &SIZES[..1]);
    for (controller, sizes) in forces.into_iter().chain([playback]) {
        let trial = Trial { controller, scenario: &content.scenario, largest: &largest, description };
        match trial.largest_passing(sizes)? {
            MotionAttempt::Failed(why) => last = why,
            MotionAttempt::Passed { motion, scenario, duration_s, results } => {
                if scenario.controller.kind == PLAYBACK {
                    let remark = "the motion is played back without forces, so the checks dynamics, power and effort are left out: with forces";
                    content.remarks.push(format!("{remark} it does not pass ({last})"));
                }
                content.scenario = *scenario;
                leave_out(&mut content, &results);
                let joints = motion.moving.iter();
                let joints = joints.map(|&at| joint_name(description, at).to_owned()).collect();
                return Ok(ScenarioDraft {
                    text: text(description, &content, duration_s),
                    remarks: content.remarks,
                    joints,
                });
            }
        }
    }
    let message = format!("no motion of this robot was found that passes: {last}");
    Err(Diagnostic::error(codes::new::SCENARIO, message).into())
}

/// Takes out the checks that have nothing to check, and the optional ones that do not pass, and says so.
fn leave_out(content: &mut ScenarioContent, results: &[CheckResult]) {
    let does_not_pass = |result: &&CheckResult| match result.status {
        Status::Pass => false,
        // There was nothing to check, such as limits that no one states, or too little.
        Status::Skipped | Status::Inconclusive => true,
        Status::Fail | Status::Error => is_optional(result.check),
    };
    let left_out: Vec<&CheckResult> = results.iter().filter(does_not_pass).collect();
    let scenario = &mut content.scenario;
    scenario.check.retain(|check| !left_out.iter().any(|result| result.check == check.kind()));
    // Of a playback it is said already.
    let without_forces = scenario.controller.kind == PLAYBACK;
    let needs_forces = |kind| matches!(kind, CheckKind::Dynamics | CheckKind::Effort | CheckKind::Power);
    for result in left_out.iter().filter(|result| !(without_forces && needs_forces(result.check))) {
        let why = lines(result).into_iter().next().unwrap_or_default();
        content.remarks.push(format!("no check {}: {why}", result.check));
    }
}

/// The limits of the check of agreement for a table that is the same as the URDF by its digits alone, and the remark on them: a
/// run is judged by a tolerance, and the robot file declares none.
fn within_digits(description: &RobotDescription) -> Option<(AgreementCheck, String)> {
    if description.declared_tolerance.is_declared() || description.places.robot_file.is_none() {
        return None;
    }
    let mut physics = SimulatedPoses::new(&description.robot).ok()?;
    let report = check(description, Ok(&mut physics), &CheckOptions::default()).ok()?;
    let allowed = report.allowed_by_digits.filter(|_| report.is_judged_by_digits())?;
    let found = report.certificate.unwrap_or_default().larger(report.worst.error);
    // Twice the difference, or less where the digits do not allow as much.
    let [position_m, orientation_rad] = [
        (2.0 * found.position_m).min(allowed.position_m.max(found.position_m)),
        (2.0 * found.orientation_rad).min(allowed.orientation_rad.max(found.orientation_rad)),
    ];
    let least = Tolerance::default();
    let [position_mm, orientation_deg] = [
        rounded_up(position_m.max(least.position_m) * 1e3),
        rounded_up(orientation_rad.max(least.orientation_rad).to_degrees()),
    ];
    let remark = format!(
        "agreement is checked within {position_mm} mm and {orientation_deg} deg: table and URDF are the same within the digits that \
         are written, up to {}, and {} declares no [tolerance]",
        length_and_angle(found.position_m, found.orientation_rad),
        description.path.file_name().unwrap_or_default().display()
    );
    let [position_mm, orientation_deg] = [position_mm, orientation_deg].map(Some);
    Some((AgreementCheck { position_mm, orientation_deg, ..AgreementCheck::default() }, remark))
}

/// A number with two digits that is not smaller.
fn rounded_up(value: f64) -> f64 {
    let text = format!("{value:e}");
    let exponent: i32 = text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or_default();
    let digits = (value * libm::pow(10.0, f64::from(1 - exponent))).ceil();
    // Read from a text, so that the number has the digits that a person would write.
    format!("{digits}e{}", exponent - 1).parse().unwrap_or(value)
}

/// The scenario without its controller, and its motion.
fn content(description: &RobotDescription, file: &Path) -> Result<(ScenarioContent, JointMove), Findings> {
    let moves = moves(description);
    let Some(first) = moves.first() else {
        let message = format!(
            "no joint between \"{}\" and \"{}\" can move: there is nothing to run",
            description.robot.link(description.base).name,
            description.robot.link(description.tip).name
        );
        return Err(Diagnostic::error(codes::new::NO_JOINT, message)
            .with_help("choose a chain in the robot file: base and tip")
            .into());
    };
    let mut content = ScenarioContent { scenario: Scenario::default(), remarks: Vec::new() };
    content.scenario.check = checks(description);
    let farthest = add_distance_checks(description, &moves, &mut content)?;
    let motion = farthest.unwrap_or_else(|| first.clone());
    let folder = file.parent().unwrap_or(Path::new("."));
    content.scenario.name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    content.scenario.robot = relative_path(folder, &absolute(&description_path(description)));
    content.scenario.start = start_settings(description, &motion);
    Ok((content, motion))
}

/// Adds the checks of distances, with what is to be said of them; returns the motion that they are for.
fn add_distance_checks(
    description: &RobotDescription,
    moves: &[JointMove],
    content: &mut ScenarioContent,
) -> Result<Option<JointMove>, Findings> {
    let remarks = &mut content.remarks;
    if let Err(findings) = description.check_capability(Capability::Clearance) {
        remarks.push(format!("no check of distances: {}", findings.to_string().replace('\n', "; ")));
        return Ok(None);
    }
    let distances = PairDistances::new(description)
        .map_err(|error| Diagnostic::error(codes::new::SHAPE, error.to_string()))?
        .farthest(description, moves);
    let Some(FarthestMove { motion, least_m, ignored, touching }) = distances else { return Ok(None) };
    if !ignored.is_empty() {
        let why = "since their convex hulls overlap or are nearer than 1 mm";
        remarks.push(format!("ignored pairs, {why}: {}", listed_pairs(&ignored)));
    }
    if !touching.is_empty() {
        let pairs = listed_pairs(&touching);
        remarks.push(format!(
            "of these, pairs that touch on this motion only: {pairs}; no motion without contact was found"
        ));
    }
    let Some(least_m) = least_m else {
        remarks.push("no check of distances: no two links could come near each other".to_owned());
        return Ok(Some(motion));
    };
    remarks.push(format!("links stay {} apart", quantity(least_m, "m")));
    let minimum_m = one_digit_below(least_m / 2.0).min(MOST_MINIMUM_M);
    let clearance = ClearanceCheck {
        minimum_m: Some(minimum_m),
        minimum_mm: None,
        pairs: Vec::new(),
        ignore: ignored.clone(),
        passing: None,
        on_violation: OnViolation::default(),
    };
    let contact = ContactCheck { ignore: ignored, ..ContactCheck::default() };
    content.scenario.check.extend([Check::Clearance(clearance), Check::Contact(contact)]);
    Ok(Some(motion))
}

fn listed_pairs(pairs: &[[String; 2]]) -> String {
    pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect::<Vec<_>>().join(", ")
}

/// The path by which a scenario names its robot: the folder of a `robot.toml`, or the file.
fn description_path(description: &RobotDescription) -> PathBuf {
    let path = &description.path;
    let is_usual = path.file_name().is_some_and(|name| name == "robot.toml");
    match path.parent().filter(|_| is_usual) {
        Some(folder) if folder.as_os_str().is_empty() => ".".into(),
        Some(folder) => folder.to_owned(),
        None => path.clone(),
    }
}

/// The largest number with one digit that is not above `value`.
fn one_digit_below(value: f64) -> f64 {
    let power = libm::log10(value).floor();
    let digit = libm::pow(10_f64, power);
    ((value / digit).floor() * digit * 1e9).round() / 1e9
}

fn joint_name(description: &RobotDescription, coordinate: usize) -> &str {
    &description.robot.joint(description.robot.movable_joints()[coordinate]).name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_distances_have_one_digit() {
        let found = [0.0334, 0.02, 0.000_17, 0.0999].map(one_digit_below);
        assert_eq!(found.map(f64::to_bits), [0.03, 0.02, 0.0001, 0.09].map(f64::to_bits));
    }
}
