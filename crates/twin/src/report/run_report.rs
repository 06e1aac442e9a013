//! The report of one run.

use congruent_agreement::{compare::PoseSource, report::ReportedDiagnosis};
use congruent_description::{Finding, InputFile};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{
    diagnosis::RunDiagnosis,
    fault::RunFault,
    motion::{ServoResult, SlowedMotion},
    run::{Outcome, RunError},
    scenario::{Expectation, MotionSettings},
    setup::RunSetup,
    source::ActuatorUse,
    verdict::{CheckResult, Status, Stop, Verdict, judge},
};

/// The whole report of one scenario.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RunReport {
    /// Name and version of this format.
    pub format: &'static str,
    /// Name of the scenario.
    pub scenario: String,
    /// The scenario file, as it was named.
    pub scenario_file: Option<String>,
    /// Values that replaced those of the file, `KEY=VALUE`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<String>,
    /// Name of the robot.
    pub robot: String,
    /// Whether the run went as the scenario expects.
    pub verdict: Verdict,
    /// The exit code that stands for the verdict.
    pub exit_code: u8,
    /// What the scenario expects.
    pub expected: Expectation,
    /// Every check.
    pub checks: Vec<CheckResult>,
    /// The check that ended the run early, and when: later steps were neither taken nor checked.
    pub stopped: Option<Stop>,
    /// The motions, one after another.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub motions: Vec<MotionTimes>,
    /// The result of each `servo_tcp`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub servos: Vec<ServoResult>,
    /// The use of each joint's actuator: its largest effort, and the shares of time that its limits held it back.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actuators: Vec<ActuatorUse>,
    /// Why model and twin differ, if a check of their agreement failed: the diagnosis of each pair of models, as
    /// `check` gives it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub diagnoses: Vec<ReportedDiagnosis>,
    /// Faults that the scenario injects into the twin.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<RunFault>,
    /// What the samples of the run show to be wrong with the twin, if a check failed: found without the knowledge of
    /// `faults`. `None` if they show nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diagnosis: Option<RunDiagnosis>,
    /// Why the run failed; `None` if it did not.
    pub error: Option<String>,
    /// The clock.
    pub simulation: RunClockReport,
    /// Seed of everything random.
    pub seed: u64,
    /// SHA-256 over the joint positions of every sample: equal runs have equal hashes.
    pub trajectory_sha256: String,
    /// The source of the model's pose of each link.
    pub links: Vec<LinkSource>,
    /// The files that it was made from: the scenario, the robot's files with its meshes, and those that the scenario
    /// names.
    pub inputs: Vec<InputFile>,
    /// Versions of the programs.
    pub versions: Versions,
    /// What was suspicious in the input.
    pub warnings: Vec<Finding>,
}

/// The clock of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunClockReport {
    /// Length of a step.
    pub step_s: f64,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time.
    pub duration_s: f64,
}

/// When a motion of the scenario begins, and how long it takes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MotionTimes {
    /// The key that tells its kind, without a unit.
    pub kind: &'static str,
    /// When it begins.
    pub starts_s: f64,
    /// How long it takes.
    pub duration_s: f64,
    /// Why it takes longer than the scenario says, if it was planned in the run, after a `servo_tcp`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slowed: Option<Finding>,
}

/// A link with the origin of its pose in the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LinkSource {
    /// The link.
    pub link: String,
    /// The source of the model's pose of it.
    pub source: PoseSource,
}

/// Programs that took part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Versions {
    /// This program.
    pub congruent: &'static str,
    /// The physics engine.
    pub physics: &'static str,
}

/// The motions as they were: one that was made slower in the run delays those after it.
fn motions(setup: &RunSetup, slowed: &[SlowedMotion]) -> Vec<MotionTimes> {
    let kinds = setup.scenario.motion.iter().map(MotionSettings::kind).enumerate();
    let longer = |chosen: &dyn Fn(usize) -> bool| {
        slowed.iter().filter(|slowed| chosen(slowed.motion)).map(|slowed| slowed.longer_s).sum::<f64>()
    };
    let times = |((index, kind), (starts_s, duration_s))| MotionTimes {
        kind,
        starts_s: starts_s + longer(&|motion| motion < index),
        duration_s: duration_s + longer(&|motion| motion == index),
        slowed: slowed.iter().find(|slowed| slowed.motion == index).map(|slowed| (&slowed.warning).into()),
    };
    kinds.zip(setup.trajectory.times()).map(times).collect()
}

impl RunReport {
    /// The report of a run.
    pub fn new(setup: &RunSetup, sources: &[PoseSource], outcome: Outcome, error: Option<&RunError>) -> Self {
        let robot = &setup.description.robot;
        let mut checks = outcome.checks;
        if error.is_some() {
            for check in checks.iter_mut().filter(|check| check.status == Status::Pass) {
                check.status = Status::Error; // it was not checked to the end
            }
        }
        let verdict = if error.is_some() { Verdict::Broken } else { judge(&setup.scenario.expect, &checks) };
        let links = robot.links().iter().zip(sources);
        let warnings = setup.description.warnings.iter().chain(&setup.warnings);

        Self {
            format: "congruent-report/1",
            scenario: setup.scenario.name.clone(),
            scenario_file: setup.path.as_ref().map(|path| path.display().to_string()),
            overrides: setup.overrides.clone(),
            robot: robot.name().to_owned(),
            verdict,
            exit_code: verdict.exit_code(),
            expected: setup.scenario.expect.clone(),
            checks,
            stopped: outcome.stopped,
            motions: motions(setup, &outcome.slowed),
            servos: outcome.servos,
            actuators: outcome.actuators,
            diagnoses: outcome.diagnoses,
            faults: setup.faults.iter().map(|fault| fault.described().clone()).collect(),
            diagnosis: outcome.diagnosis,
            error: error.map(ToString::to_string),
            simulation: RunClockReport {
                step_s: setup.clock.step_s,
                steps: outcome.steps,
                duration_s: setup.clock.time_s(outcome.steps),
            },
            seed: setup.scenario.seed,
            trajectory_sha256: outcome.trajectory_sha256,
            links: links.map(|(link, &source)| LinkSource { link: link.name.clone(), source }).collect(),
            inputs: setup.inputs.clone(),
            versions: Versions {
                congruent: env!("CARGO_PKG_VERSION"),
                physics: congruent_simulation::ENGINE,
            },
            warnings: warnings.map(Finding::from).collect(),
        }
    }

    /// The file `report.json`.
    ///
    /// # Errors
    /// A value is no JSON, which none is.
    pub fn to_json(&self) -> serde_json::Result<Vec<u8>> {
        let mut json = serde_json::to_vec_pretty(self)?;
        json.push(b'\n');
        Ok(json)
    }

    /// The verdict as a sentence.
    pub fn sentence(&self) -> String {
        let failed = self.checks.iter().filter(|check| check.status == Status::Fail);
        let failed: Vec<&str> = failed.map(|check| check.check.word()).collect();
        let failed = match &*failed {
            [] => String::new(),
            [one] => format!("{one} fails"),
            [others @ .., last] => format!("{} and {last} fail", others.join(", ")),
        };
        match (self.verdict, &self.expected) {
            (Verdict::AsExpected, Expectation::Pass) => "every check passes, as expected".to_owned(),
            (Verdict::AsExpected, Expectation::Fail { .. }) => format!("{failed}, as expected"),
            (Verdict::NotAsExpected, _) if failed.is_empty() => {
                "every check passes, against expectation".to_owned()
            }
            (Verdict::NotAsExpected, _) => format!("{failed}, against expectation"),
            (Verdict::NothingChecked, _) => "nothing was checked".to_owned(),
            (Verdict::Broken, _) => "the run ended with an error".to_owned(),
        }
    }

    /// The command that runs the same again.
    pub fn command(&self) -> String {
        let file = self.scenario_file.as_deref().unwrap_or("FILE");
        let quoted = |change: &String| format!("--set '{}'", change.replace('\'', r"'\''"));
        let has_seed = self.overrides.iter().any(|change| change.starts_with("seed="));
        let seed = (!has_seed).then(|| format!("--seed {}", self.seed));
        let words = ["congruent run".to_owned(), file.to_owned()].into_iter();
        words.chain(self.overrides.iter().map(quoted)).chain(seed).collect::<Vec<_>>().join(" ")
    }

    /// The checks, those that failed first.
    pub fn checks_failed_first(&self) -> Vec<&CheckResult> {
        let mut checks: Vec<&CheckResult> = self.checks.iter().collect();
        let rank = |check: &CheckResult| !matches!(check.status, Status::Fail | Status::Error);
        let first_s = |check: &CheckResult| {
            let violations = check.measures.iter().filter_map(|measure| measure.first_violation.as_ref());
            violations.map(|violation| violation.time_s).fold(f64::INFINITY, f64::min)
        };
        checks.sort_by(|a, b| rank(a).cmp(&rank(b)).then(first_s(a).total_cmp(&first_s(b))));
        checks
    }
}
