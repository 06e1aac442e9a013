//! `congruent new scenario`: a scenario that passes, found by trying it.

use std::path::{Path, PathBuf};

use congruent_agreement::compare::CheckReport;
use congruent_description::{ReportedChain, RobotDescription, Tolerance};
use congruent_input::{
    Capability, Diagnostic, Finding, Findings,
    display::{length_and_angle, quantity},
};
use congruent_monitors::{
    NoRecorder,
    verdict::{CheckResult, Status},
};
use congruent_results::report::lines;
use congruent_scenario::{
    AgreementCheck, Check, CheckKind, ClearanceCheck, ContactCheck, ControllerKind, ControllerSettings,
    OnViolation, Scenario,
};
use congruent_twin::{Outcome, Run, RunError, RunSetup};
use congruent_writers::relative_path;
use schemars::JsonSchema;
use serde::Serialize;

use crate::codes;
use crate::{
    joint_move::{JointMove, moves},
    scenario_text::{ScenarioContent, text},
    settings::{checks, computed_torque, gravity_compensation, motion_settings, start_settings},
    touching::{FarthestMove, PairDistances},
    written::absolute,
};

/// Distance that links must keep at least, or half of the smallest distance of the motion if that is less. Unit: m.
const MOST_MINIMUM_M: f64 = 0.02;
/// The controller that places the robot at its setpoint.
const PLAYBACK: ControllerKind = ControllerKind::Kinematic;
/// Sizes of the motion that are tried with forces, the largest first.
const SIZES: [f64; 3] = [1.0, 0.5, 0.25];

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
/// links stay apart, and all checks pass. `checked` is the check of the robot: it is asked if the robot declares no tolerance.
///
/// # Errors
/// What keeps the robot from being simulated, or from passing.
pub fn scenario(
    description: &RobotDescription,
    file: &Path,
    checked: impl FnOnce() -> Option<CheckReport>,
) -> Result<ScenarioDraft, Findings> {
    description.check_capability(Capability::Physics)?;
    let (mut content, largest) = content(description, file)?;
    let checked = if description.declared_tolerance.is_declared() { None } else { checked() };
    if let Some((agreement, remark)) = checked.and_then(|report| within_digits(description, &report)) {
        content.scenario.check.retain(|check| check.kind() != CheckKind::Agreement);
        content.scenario.check.insert(0, Check::Agreement(agreement));
        content.remarks.push(remark);
    }
    let mut last = String::new();
    // With forces first, and the largest motion first: the more of the robot a scenario exercises, the more it
    // checks. Playback always remains.
    let forces = [computed_torque(), gravity_compensation()];
    let forces = forces.into_iter().flat_map(|controller| SIZES.map(|size| (size, controller.clone())));
    let playback = std::iter::once((1.0, ControllerSettings::default()));
    for (size, controller) in forces.chain(playback) {
        let is_playback = controller.kind == PLAYBACK;
        let motion = largest.scaled(&description.robot, size);
        content.scenario.motion = motion_settings(description, &motion);
        content.scenario.controller = controller;
        let (results, setup) = match tried(&content.scenario, description) {
            Ok(tried) => tried,
            Err(findings) if is_playback => return Err(findings),
            Err(findings) => {
                last = findings.to_string();
                continue;
            }
        };
        match refused(&results) {
            // No controller or size changes the geometry: to try further would not help.
            Some((CheckKind::Agreement, why)) => return Err(disagrees(description, &why).into()),
            Some((_, why)) => last = why,
            None => {
                if is_playback {
                    let remark = "the motion is played back without forces, so the checks dynamics, power and effort are left out: with forces";
                    content.remarks.push(format!("{remark} it does not pass ({last})"));
                }
                leave_out(&mut content, &results);
                let joints = motion.moving.iter();
                let joints = joints.map(|&at| joint_name(description, at).to_owned()).collect();
                return Ok(ScenarioDraft {
                    text: text(description, &content, setup.clock.duration_s()),
                    remarks: content.remarks,
                    joints,
                });
            }
        }
    }
    let message = format!("no motion of this robot was found that passes: {last}");
    Err(Diagnostic::error(codes::new::SCENARIO, message).into())
}

/// Runs a scenario without recording it.
///
/// # Errors
/// What is wrong with it, or what has broken the run.
pub fn try_scenario(setup: &RunSetup) -> Result<Outcome, Findings> {
    let mut checks = setup.checks();
    let mut run = Run::new(setup).map_err(|error| broken(&error))?;
    let (outcome, result) = run.finish(&mut checks, &mut NoRecorder, |_| {});
    result.map_err(|error| broken(&error))?;
    Ok(outcome)
}

/// Runs a scenario up to the first check that must pass and does not: a controller that cannot hold the arm fails it early.
fn tried(
    scenario: &Scenario,
    description: &RobotDescription,
) -> Result<(Vec<CheckResult>, RunSetup), Findings> {
    let setup = RunSetup::new(scenario.clone(), description.clone())?;
    let mut checks = setup.checks();
    let mut run = Run::new(&setup).map_err(|error| broken(&error))?;
    let broken = |error: RunError| broken(&error);
    run.compare().map_err(|error| broken(error.into()))?;
    while !run.observe(&mut checks, &mut NoRecorder).map_err(broken)? {
        if checks.iter().any(|check| check.monitor.has_failed() && !is_optional(check.kind)) {
            break;
        }
        run.step().map_err(broken)?;
        run.compare().map_err(|error| broken(error.into()))?;
    }
    let results = checks.iter().map(|check| check.result(run.names())).collect();
    drop((checks, run));
    Ok((results, setup))
}

fn broken(error: &dyn std::error::Error) -> Diagnostic {
    Diagnostic::error(codes::new::RUN, error.to_string())
}

/// Checks that say how well the physics follows the equations of motion: they are left out if they do not pass, which says
/// nothing about the scenario.
fn is_optional(kind: CheckKind) -> bool {
    matches!(kind, CheckKind::Dynamics | CheckKind::Power | CheckKind::Twist)
}

/// The first check that must pass and does not.
fn refused(results: &[CheckResult]) -> Option<(CheckKind, String)> {
    let failed = |result: &&CheckResult| result.status == Status::Fail && !is_optional(result.check);
    let result = results.iter().find(failed)?;
    // The violation is the first of its lines.
    let why = lines(result).into_iter().next().unwrap_or_default();
    Some((result.check, format!("check {}: {why}", result.check)))
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

fn disagrees(description: &RobotDescription, why: &str) -> Diagnostic {
    let message = format!("the model and the twin of \"{}\" are not the same robot: {why}", description.name);
    Diagnostic::error(codes::new::AGREEMENT, message)
        .with_help("`congruent check` says why; a scenario can only pass for a robot that agrees")
}

/// The limits of the check of agreement for a table that is the same as the URDF by its digits alone, and the remark on them: a
/// run is judged by a tolerance, and the robot file declares none.
fn within_digits(description: &RobotDescription, report: &CheckReport) -> Option<(AgreementCheck, String)> {
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
