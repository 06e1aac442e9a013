//! The report of an earlier run, if a run now would give the same.

use congruent_agreement::compare::PoseSource;
use serde::Deserialize;

use super::run_report::{LinkSource, RunClockReport, RunReport};
use crate::{
    diagnosis::RunDiagnosis,
    motion::ServoResult,
    run::Outcome,
    setup::RunSetup,
    source::ActuatorUse,
    verdict::{CheckResult, Stop},
};

/// What only a run can find out.
#[derive(Deserialize)]
struct Found {
    checks: Vec<CheckResult>,
    stopped: Option<Stop>,
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
        diagnoses: Vec::new(),
        diagnosis,
    };
    let sources: Vec<PoseSource> = links.iter().map(|link| link.source).collect();
    let report = RunReport::new(setup, &sources, outcome, None);
    (report.to_json().ok()? == file).then_some(report)
}
