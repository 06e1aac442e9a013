//! Trying a motion of a scenario: with which controller and how large it passes.

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Findings};
use congruent_monitors::{
    NoRecorder,
    verdict::{CheckResult, Status},
};
use congruent_results::report::lines;
use congruent_scenario::{CheckKind, ControllerKind, ControllerSettings, Scenario};
use congruent_twin::{Outcome, Run, RunError, RunSetup};

use crate::{codes, joint_move::JointMove, settings::motion_settings};

/// The controller that places the robot at its setpoint.
pub(super) const PLAYBACK: ControllerKind = ControllerKind::Kinematic;
/// Sizes of the motion that are tried with forces, the largest first.
pub(super) const SIZES: [f64; 3] = [1.0, 0.5, 0.25];

/// A scenario to be tried with a controller.
pub(super) struct Trial<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) description: &'a RobotDescription,
    pub(super) controller: ControllerSettings,
    /// The motion of size 1.
    pub(super) largest: &'a JointMove,
}

/// What came of one size of the motion.
pub(super) enum MotionAttempt {
    Passed { motion: JointMove, scenario: Box<Scenario>, duration_s: f64, results: Vec<CheckResult> },
    Failed(String),
}

impl Trial<'_> {
    /// The attempt with the largest of these sizes that passes, or why the last does not: what a controller does not follow at the
    /// smallest size, it does not follow at those between.
    pub(super) fn largest_passing(&self, sizes: &[f64]) -> Result<MotionAttempt, Findings> {
        let [largest, between @ .., smallest] = sizes else { return self.attempt(sizes[0]) };
        let first = self.attempt(*largest)?;
        if matches!(first, MotionAttempt::Passed { .. }) {
            return Ok(first);
        }
        let last = self.attempt(*smallest)?;
        if matches!(last, MotionAttempt::Failed(_)) {
            return Ok(last);
        }
        for size in between {
            let attempt = self.attempt(*size)?;
            if matches!(attempt, MotionAttempt::Passed { .. }) {
                return Ok(attempt);
            }
        }
        Ok(last)
    }

    /// Tries one size of the motion.
    ///
    /// # Errors
    /// What no other size and no controller would change.
    fn attempt(&self, size: f64) -> Result<MotionAttempt, Findings> {
        let motion = self.largest.scaled(&self.description.robot, size);
        let scenario = Scenario {
            motion: motion_settings(self.description, &motion),
            controller: self.controller.clone(),
            ..self.scenario.clone()
        };
        let (results, setup) = match tried(&scenario, self.description) {
            Ok(tried) => tried,
            Err(findings) if self.controller.kind == PLAYBACK => return Err(findings),
            Err(findings) => return Ok(MotionAttempt::Failed(findings.to_string())),
        };
        match refused(&results) {
            // No controller or size changes the geometry: to try further would not help.
            Some((CheckKind::Agreement, why)) => Err(disagrees(self.description, &why).into()),
            Some((_, why)) => Ok(MotionAttempt::Failed(why)),
            None => {
                let duration_s = setup.clock.duration_s();
                Ok(MotionAttempt::Passed { motion, scenario: Box::new(scenario), duration_s, results })
            }
        }
    }
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
pub(super) fn is_optional(kind: CheckKind) -> bool {
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

fn disagrees(description: &RobotDescription, why: &str) -> Diagnostic {
    let message = format!("the model and the twin of \"{}\" are not the same robot: {why}", description.name);
    Diagnostic::error(codes::new::AGREEMENT, message).with_help(
        "`congruent check` of the robot says why; a scenario can only pass for a robot that agrees",
    )
}
