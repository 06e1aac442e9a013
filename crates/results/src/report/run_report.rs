//! The report of one run.

use congruent_agreement::{compare::PoseSource, report::ReportedDiagnosis};
use congruent_fault_diagnosis::RunDiagnosis;
use congruent_input::{Finding, InputFile, portable_text};
use congruent_monitors::verdict::{CheckResult, RunStop, Status, Verdict, judge};
use congruent_motion::{ServoResult, SlowedMotion};
use congruent_scenario::{Expectation, RunFault};
use congruent_twin::{CaseValue, Outcome, RunError, RunSetup, source::ActuatorUse};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, de::IgnoredAny};

use super::{
    after_run::AfterRun,
    cases::{CheckInCases, RequirementVerdict, UncertaintyReport, uncertainty_sentence},
    portable::{portable, portable_diagnosis, portable_finding},
    source_report::SourceReport,
    verdict_sentence::verdict_sentence,
};

/// The whole report of one scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunReport {
    /// Name and version of this format.
    pub format: String,
    /// Name of the scenario.
    pub scenario: String,
    /// The scenario file as it was named; relative to the current folder if that was an absolute path.
    pub scenario_file: Option<String>,
    /// Values that replaced those of the file, `KEY=VALUE`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<String>,
    /// Name of the robot.
    pub robot: String,
    /// Whether the run went as the scenario expects.
    pub verdict: Verdict,
    /// Exit code of the program for that verdict.
    pub exit_code: u8,
    /// The verdict that the scenario expects.
    pub expected: Expectation,
    /// The result of every check, in the order of the scenario; default checks last.
    pub checks: Vec<CheckResult>,
    /// The check that ended the run early, and when: later steps were neither taken nor checked.
    pub stopped: Option<RunStop>,
    /// The case of `[uncertainty]` that ran alone; left out for a scenario as it is written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub case: Option<CaseOfRun>,
    /// What the cases of `[uncertainty]` show; left out if the scenario has none, or if one of them ran alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintyReport>,
    /// The motions, one after another.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motions: Vec<MotionTimes>,
    /// The result of each `servo_tcp`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub servos: Vec<ServoResult>,
    /// The use of each joint's actuator: its largest effort, and the shares of time at its limits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub actuators: Vec<ActuatorUse>,
    /// Why model and twin differ, if a check of their agreement failed: the diagnosis of each pair of models, as
    /// `check` gives it.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "not_read")]
    pub diagnoses: Vec<ReportedDiagnosis>,
    /// Faults that the scenario injects into the twin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<RunFault>,
    /// Faults that the diagnosis found in the samples of the run, without knowledge of `faults`, if a check failed. `None` if
    /// it found none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diagnosis: Option<RunDiagnosis>,
    /// Why the run failed; `None` if it did not.
    pub error: Option<String>,
    /// The log whose joint states the run took; left out for a simulation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceReport>,
    /// Step, number of steps and duration; of a log the period, number and time of its samples.
    pub simulation: RunClockReport,
    /// Seed of everything random.
    pub seed: u64,
    /// SHA-256 over the joint positions of every sample: equal runs have equal hashes.
    pub trajectory_sha256: String,
    /// The source of the model's pose of each link.
    pub links: Vec<LinkSource>,
    /// The files that the run was made from: the scenario, the robot's files with its meshes, and those that the scenario
    /// names.
    pub inputs: Vec<InputFile>,
    /// Versions of this program and of the physics engine.
    pub versions: Versions,
    /// Warnings about the scenario and the robot.
    pub warnings: Vec<Finding>,
}

/// The causes of a failed agreement are written for people: no reader of a report needs them.
fn not_read<'de, D: Deserializer<'de>, T>(value: D) -> Result<Vec<T>, D::Error> {
    IgnoredAny::deserialize(value).map(|_| Vec::new())
}

/// A case of `[uncertainty]` that ran alone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseOfRun {
    /// Number of the case, from 0.
    pub case: u64,
    /// Its values.
    pub values: Vec<CaseValue>,
}

/// The clock of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RunClockReport {
    /// Length of a physics step.
    pub step_s: f64,
    /// Number of steps that were taken.
    pub steps: u64,
    /// Simulated time of these steps.
    pub duration_s: f64,
}

/// Start and duration of a motion of the scenario.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MotionTimes {
    /// Kind of the motion: its key in the scenario, without a unit.
    pub kind: String,
    /// Start of the motion, from the start of the run.
    pub starts_s: f64,
    /// Duration of the motion.
    pub duration_s: f64,
    /// Why the motion takes longer than the scenario says, if it was planned during the run, after a `servo_tcp`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slowed: Option<Finding>,
}

/// A link with the origin of its pose in the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LinkSource {
    /// Name of the link.
    pub link: String,
    /// Origin of the link's pose in the model: the table or the URDF.
    pub source: PoseSource,
}

/// Programs that took part.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Versions {
    /// Version of this program.
    pub congruent: String,
    /// Name and version of the physics engine.
    pub physics: String,
}

impl Versions {
    /// Of this program and the engine that it is built with.
    pub fn current() -> Self {
        Self {
            congruent: env!("CARGO_PKG_VERSION").to_owned(),
            physics: congruent_simulation::ENGINE.to_owned(),
        }
    }
}

/// The motions as they were: one that was made slower in the run delays those after it.
fn motions(setup: &RunSetup, slowed: &[SlowedMotion]) -> Vec<MotionTimes> {
    let kinds = setup.scenario.motion.iter().map(|motion| motion.kind().to_owned()).enumerate();
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

/// The verdict of a run with that of its cases.
fn with_cases(own: Verdict, cases: Option<&UncertaintyReport>) -> Verdict {
    match cases {
        Some(cases) if own == Verdict::AsExpected => match cases.verdict {
            _ if !cases.is_whole() => Verdict::Broken,
            RequirementVerdict::Met => Verdict::AsExpected,
            RequirementVerdict::NotMet => Verdict::NotAsExpected,
            RequirementVerdict::NotEnoughCases => Verdict::NotEnoughCases,
        },
        _ => own,
    }
}

impl RunReport {
    /// The report of a run.
    pub fn new(
        setup: &RunSetup,
        sources: &[PoseSource],
        outcome: Outcome,
        after: AfterRun,
        error: Option<&RunError>,
    ) -> Self {
        let robot = &setup.description.robot;
        let mut checks = outcome.checks;
        for note in checks.iter_mut().flat_map(|check| &mut check.notes) {
            *note = portable_text(note, &setup.inputs);
        }
        if error.is_some() {
            for check in checks.iter_mut().filter(|check| check.status == Status::Pass) {
                check.status = Status::Error; // it was not checked to the end
            }
        }
        let verdict = if error.is_some() {
            Verdict::Broken
        } else {
            with_cases(judge(&setup.scenario.expect, &checks), after.cases.as_ref())
        };
        let links = robot.links().iter().zip(sources);
        let warnings = setup.description.warnings.iter().chain(&setup.warnings);

        Self {
            format: "congruent-report/1".to_owned(),
            scenario: setup.scenario.name.clone(),
            scenario_file: setup.path.as_deref().map(portable),
            overrides: setup.overrides.clone(),
            robot: setup.description.name.clone(),
            verdict,
            exit_code: verdict.exit_code(),
            expected: setup.scenario.expect.clone(),
            checks,
            stopped: outcome.stopped,
            case: setup
                .uncertain_case
                .as_ref()
                .map(|of| CaseOfRun { case: of.case, values: of.values.clone() }),
            uncertainty: after.cases,
            motions: motions(setup, &outcome.slowed),
            servos: outcome.servos,
            actuators: outcome.actuators,
            diagnoses: after.poses.into_iter().map(portable_diagnosis).collect(),
            faults: setup.faults.iter().map(|fault| fault.described().clone()).collect(),
            diagnosis: after.samples,
            error: error.map(ToString::to_string),
            source: SourceReport::of(setup),
            simulation: RunClockReport {
                step_s: setup.clock.step_s,
                steps: outcome.steps,
                duration_s: outcome.duration_s,
            },
            seed: setup.scenario.seed,
            trajectory_sha256: outcome.trajectory_sha256,
            links: links.map(|(link, &source)| LinkSource { link: link.name.clone(), source }).collect(),
            inputs: setup.inputs.clone(),
            versions: Versions::current(),
            warnings: warnings.map(|warning| portable_finding(warning.into())).collect(),
        }
    }

    /// The file `report.json`.
    ///
    /// # Errors
    /// A value is no JSON, which none is.
    pub fn to_json(&self) -> serde_json::Result<Vec<u8>> {
        let mut json = self.portable(&serde_json::to_string_pretty(self)?);
        json.push('\n');
        Ok(json.into_bytes())
    }

    /// A text about the run without absolute paths of its inputs.
    pub fn portable(&self, text: &str) -> String {
        portable_text(text, &self.inputs)
    }

    /// The reason for the verdict as a sentence.
    pub fn sentence(&self) -> String {
        let results = || self.checks.iter().map(|check| (check.check, check.status));
        let own = judge(&self.expected, &self.checks);
        match &self.uncertainty {
            Some(cases) if self.error.is_none() => {
                uncertainty_sentence(own, &verdict_sentence(own, &self.expected, results()), cases)
            }
            _ => verdict_sentence(self.verdict, &self.expected, results()),
        }
    }

    /// The command that runs the same again.
    pub fn command(&self) -> String {
        let quoted = |word: &str| format!("'{}'", word.replace('\'', r"'\''"));
        let file = self.scenario_file.as_deref().unwrap_or("FILE");
        let file = if file.contains(char::is_whitespace) { quoted(file) } else { file.to_owned() };
        let set = |change: &String| format!("--set {}", quoted(change));
        let has_seed = self.overrides.iter().any(|change| change.starts_with("seed="));
        let seed = (!has_seed).then(|| format!("--seed {}", self.seed));
        let words = ["congruent run".to_owned(), file].into_iter();
        words.chain(self.overrides.iter().map(set)).chain(seed).collect::<Vec<_>>().join(" ")
    }

    /// What to run next of a scenario with cases, and the command: as many cases as would answer; or the first case in which a check
    /// fails, or else the worst of the first quantity, with page and recording.
    pub fn command_of_cases(&self) -> Option<(&'static str, String)> {
        let cases = self.uncertainty.as_ref()?;
        let needed = cases.checks.iter().filter_map(|check| check.requirement.cases_needed).max();
        if let (Verdict::NotEnoughCases, Some(needed)) = (self.verdict, needed) {
            return Some(("what would answer", self.command_with(&format!("uncertainty.cases={needed}"))));
        }
        let checks = cases.checks_failed_first();
        let failing = |is_met: bool| {
            let of_verdict =
                |check: &&&CheckInCases| (check.requirement.verdict == RequirementVerdict::Met) == is_met;
            checks.iter().filter(of_verdict).filter_map(|check| check.first_failing).min()
        };
        if let Some(case) = failing(false).or_else(|| failing(true)) {
            return Some(("the first case that fails", self.command_of(case)));
        }
        let worst =
            checks.iter().flat_map(|check| &check.quantities).map(|quantity| quantity.worst_case).next();
        Some(("the worst case", self.command_of(worst?)))
    }

    /// The command that runs a case of `[uncertainty]` alone.
    pub(super) fn command_of(&self, case: u64) -> String {
        self.command_with(&format!("uncertainty.case={case}"))
    }

    /// The command with one value more, in place of an earlier one of its key.
    fn command_with(&self, set: &str) -> String {
        let key = set.split('=').next().unwrap_or(set);
        let others = self.overrides.iter().filter(|change| change.split('=').next() != Some(key));
        let with = Self { overrides: others.cloned().chain([set.to_owned()]).collect(), ..self.clone() };
        with.command()
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
