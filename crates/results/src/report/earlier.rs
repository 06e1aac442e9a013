//! The report of an earlier run, if a new run would give the same result.

use congruent_agreement::compare::PoseSource;
use congruent_fault_diagnosis::RunDiagnosis;
use congruent_monitors::verdict::{CheckResult, RunStop};
use congruent_motion::ServoResult;
use congruent_twin::{Outcome, RunSetup, source::ActuatorUse};
use serde::Deserialize;

use super::causes::Causes;
use super::run_report::{LinkSource, RunClockReport, RunReport};

/// The parts of a report that only a run can compute.
#[derive(Deserialize)]
struct Found {
    checks: Vec<CheckResult>,
    stopped: Option<RunStop>,
    #[serde(default)]
    servos: Vec<ServoResult>,
    #[serde(default)]
    actuators: Vec<ActuatorUse>,
    diagnosis: Option<RunDiagnosis>,
    simulation: RunClockReport,
    trajectory_sha256: String,
    links: Vec<LinkSource>,
}

/// The report in this file, if it is that of a finished run of the same inputs, values and versions.
///
/// All that does not come from the run itself is made anew from `setup`, hashes of files included; the result must be the
/// file, to the last byte. A run that broke is not finished. Neither is one taken to be whose report says more than can be
/// read back: the cause of a failed agreement, or a motion that was slowed in the run.
pub fn earlier_report(setup: &RunSetup, file: &[u8]) -> Option<RunReport> {
    let Found { checks, stopped, servos, actuators, diagnosis, simulation, trajectory_sha256, links } =
        serde_json::from_slice(file).ok()?;
    let outcome = Outcome {
        checks,
        steps: simulation.steps,
        stopped,
        servos,
        slowed: Vec::new(),
        actuators,
        trajectory_sha256,
    };
    let sources: Vec<PoseSource> = links.iter().map(|link| link.source).collect();
    let report = RunReport::new(setup, &sources, outcome, Causes::from_samples(diagnosis), None);
    (report.to_json().ok()? == file).then_some(report)
}
