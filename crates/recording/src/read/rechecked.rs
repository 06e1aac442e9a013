//! The result of [`recheck`](super::recheck).

use congruent_input::{Quantity, SiUnit};
use congruent_monitors::verdict::{Bound, Status, Verdict};
use congruent_results::report::verdict_sentence;
use congruent_scenario::{CheckKind, Expectation};
use schemars::JsonSchema;
use serde::Serialize;

use super::evidence::{Evidence, TimedValue};

/// The checks of a scenario, evaluated once more on a recording.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Recheck {
    /// The scenario file whose checks were evaluated, as it was named.
    pub scenario: Option<String>,
    /// Whether the scenario has the limits and the expectation of the run, so that the verdict must be the same.
    pub same_limits: bool,
    /// Number of recorded samples at which checks were evaluated.
    pub instants: usize,
    /// The longest time between two of them.
    pub gap_s: f64,
    /// The length of a step of the run: what happened between two samples is in the recording as the worst values of
    /// some checks only.
    pub step_s: f64,
    /// What the scenario expects.
    pub expected: Expectation,
    /// The verdict that follows from the recording.
    pub verdict: Verdict,
    /// Whether it is that of the run.
    pub same_verdict: bool,
    /// The verdict of the run.
    pub recorded_verdict: String,
    /// Every check, in the order of the scenario.
    pub checks: Vec<RecheckedCheck>,
    /// Where the recorded series contradict the recorded report.
    pub disagreements: Vec<Disagreement>,
    /// Samples that are missing, or at a time at which the run has none: the first of each series.
    pub samples: Vec<String>,
}

/// From what a check was evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// The worst values of the check between recorded samples: every step of the run.
    EveryStep,
    /// The joint states or errors at recorded samples.
    RecordedSamples,
    /// The report in the recording alone: the check cannot be evaluated on the recording.
    Report,
}

impl Basis {
    /// The weakest; the report if there is none.
    pub(super) fn worst(all: impl Iterator<Item = Self>) -> Self {
        all.max().unwrap_or(Self::Report)
    }
}

/// A check, evaluated once more.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RecheckedCheck {
    /// Kind of the check, such as `clearance`.
    pub check: CheckKind,
    /// Its line in the scenario file, from 1.
    pub line: Option<usize>,
    /// The result on the recording.
    pub status: Status,
    /// The result of the run.
    pub recorded_status: String,
    /// Origin of its values: the weakest origin among its quantities.
    pub basis: Basis,
    /// The quantities that the check limits, each with its worst value.
    pub quantities: Vec<RecheckedQuantity>,
}

/// A quantity of a check.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RecheckedQuantity {
    /// Name of the quantity, as in the report of the run.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// SI unit of limits and values; empty if they have none.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// On which side of the limit it must be.
    pub bound: Bound,
    /// The limit of the scenario.
    pub limit: f64,
    /// The limit of the run.
    pub recorded_limit: f64,
    /// The worst value in the recording; `null` for infinity.
    #[schemars(with = "Option<f64>")]
    pub worst: f64,
    /// Simulated time of the worst value. Unit: s.
    pub worst_s: f64,
    /// The link, joint or pair with the worst value.
    pub subject: Option<String>,
    /// The worst value of the run; `null` for infinity.
    #[schemars(with = "Option<f64>")]
    pub recorded_worst: f64,
    /// Simulated time of the first violation; `null` if there is none. Unit: s.
    pub violation_s: Option<f64>,
    /// Origin of the value.
    pub basis: Basis,
}

/// A contradiction between the recorded series and the recorded report.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Disagreement {
    /// The kind of check.
    pub check: CheckKind,
    /// Its line in the scenario file, from 1.
    pub line: Option<usize>,
    /// The quantity; `None` if it is the result of the whole check.
    #[schemars(with = "Option<String>")]
    pub quantity: Option<Quantity>,
    /// The unit of the value.
    #[schemars(with = "Option<String>")]
    pub unit: Option<SiUnit>,
    /// Simulated time of the value, `null` for the result of a whole check. Unit: s.
    pub time_s: Option<f64>,
    /// The value of the series.
    pub value: Option<f64>,
    /// What is wrong with it.
    pub problem: String,
}

impl Disagreement {
    /// A contradiction about a value of a quantity.
    pub(super) fn new(
        check: CheckKind,
        line: Option<usize>,
        of: &Evidence,
        at: TimedValue,
        problem: String,
    ) -> Self {
        let (quantity, unit) = (Some(of.of.name), Some(of.of.unit));
        Self { check, line, quantity, unit, time_s: Some(at.time_s), value: Some(at.value), problem }
    }

    /// About the result of a check.
    pub(super) fn contradicted_status(
        check: CheckKind,
        line: Option<usize>,
        status: Status,
        recorded: Status,
    ) -> Self {
        let (found, recorded) = (status.word(), recorded.word());
        let problem = format!("is `{found}` on the recording and `{recorded}` in its report");
        Self { check, line, quantity: None, unit: None, time_s: None, value: None, problem }
    }
}

impl Recheck {
    /// The reason for the verdict as a sentence, as that of a run.
    pub fn sentence(&self) -> String {
        let results = self.checks.iter().map(|check| (check.check, check.status));
        verdict_sentence(self.verdict, &self.expected, results)
    }

    /// 0 if the recording shows what its report says and the verdict is as the scenario expects, 1 otherwise, and the code
    /// of a run that broke or checked nothing.
    pub fn exit_code(&self) -> u8 {
        match self.verdict {
            // A contradiction is never success, whatever the scenario expects.
            _ if !self.disagreements.is_empty()
                || !self.samples.is_empty()
                || self.same_limits && !self.same_verdict =>
            {
                1
            }
            verdict => verdict.exit_code(),
        }
    }
}

impl RecheckedCheck {
    /// Whether its limits are those of the run.
    pub(super) fn has_same_limits(&self) -> bool {
        self.quantities.iter().all(RecheckedQuantity::has_same_limit)
    }
}

impl RecheckedQuantity {
    /// Whether the limit is that of the run.
    pub(super) fn has_same_limit(&self) -> bool {
        self.limit.to_bits() == self.recorded_limit.to_bits()
    }
}
