//! The report of an earlier run, if a new run would give the same result.

use congruent_agreement::compare::PoseSource;
use congruent_twin::{Outcome, RunSetup};

use super::{after_run::AfterRun, run_report::RunReport};

/// The report in this file, if it is that of a finished run of the same inputs, values and versions.
///
/// All that does not come from the run itself is made anew from `setup`, hashes of files included; the result must be the
/// file, to the last byte. A run that broke is not finished. Neither is one taken to be whose report says more than can be
/// read back: the cause of a failed agreement, or a motion that was slowed in the run.
pub fn earlier_report(setup: &RunSetup, file: &[u8]) -> Option<RunReport> {
    let read: RunReport = serde_json::from_slice(file).ok()?;
    let outcome = Outcome {
        checks: read.checks,
        steps: read.simulation.steps,
        duration_s: read.simulation.duration_s,
        stopped: read.stopped,
        servos: read.servos,
        slowed: Vec::new(),
        actuators: read.actuators,
        trajectory_sha256: read.trajectory_sha256,
    };
    let sources: Vec<PoseSource> = read.links.iter().map(|link| link.source).collect();
    let after = AfterRun { cases: read.uncertainty, ..AfterRun::from_samples(read.diagnosis) };
    let report = RunReport::new(setup, &sources, outcome, after, None);
    (report.to_json().ok()? == file).then_some(report)
}
