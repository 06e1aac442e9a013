//! The result of [`inspect`](super::inspect): ordered lists.

use std::collections::BTreeMap;

use congruent_input::{
    Quantity, SiUnit,
    display::{counted, quantity},
};
use congruent_monitors::verdict::{Bound, CheckResult, Measure, Verdict};
use congruent_results::report::{RunReport, verdict_line};
use schemars::JsonSchema;
use serde::Serialize;

use super::rechecked::Recheck;

/// The property that holds the verdict.
pub(super) const VERDICT: &str = "congruent/verdict";

/// The content of a recording.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct RecordingSummary {
    /// Name and version of this format.
    pub format: &'static str,
    /// The application id of the recording.
    pub application_id: String,
    /// The id of the recording.
    pub recording_id: String,
    /// Size of the file, in bytes.
    pub bytes: u64,
    /// Whether the file was read to its footer; otherwise it is cut off or damaged, or the recording was not finished.
    pub complete: bool,
    /// Problems with the file or its values.
    pub problems: Vec<String>,
    /// The run's verdict, if this program made the recording.
    pub verdict: Option<String>,
    /// The exit code of `inspect`: that of the run, 2 if the file is cut off or has problems, 4 without a verdict.
    pub exit_code: u8,
    /// Reason for the exit code.
    pub reason: String,
    /// From the first to the last time of the recording, on its first timeline of times; `None` without one.
    pub duration_s: Option<f64>,
    /// The checks of the run with their worst values, if this program made the recording.
    pub checks: Vec<CheckSummary>,
    /// What has changed since the run of the files that it was made from: the scenario, the robot's files, meshes. `null` if
    /// they are not there to be compared, or may not be opened.
    pub changed_inputs: Option<Vec<String>>,
    /// Results that the run wrote and that are not beside the recording: nothing is compared with them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub missing_results: Vec<String>,
    /// The checks of a scenario, evaluated once more, if `--check` is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recheck: Option<Recheck>,
    /// Whether the file contains a layout for the viewer.
    pub has_layout: bool,
    /// Timelines of the recording with their ranges, sorted by name.
    pub timelines: Vec<TimelineSummary>,
    /// Entities with their numbers of rows and chunks, sorted by path.
    pub entities: Vec<EntitySummary>,
    /// Scalars over time, by path.
    pub scalars: Vec<ScalarSummary>,
    /// Properties of the recording, by name.
    pub properties: BTreeMap<String, serde_json::Value>,
    /// The report of the run, if this program made the recording.
    pub report: Option<serde_json::Value>,
    /// That report, read back.
    #[serde(skip)]
    pub run: Option<RunReport>,
}

impl RecordingSummary {
    /// Name and verdict, with the reason, the number of checks, the duration and what made the recording, in one line.
    pub fn headline(&self) -> String {
        let run = self.run.as_ref();
        let name = run.map_or(self.application_id.as_str(), |run| run.scenario.as_str());
        let mut parts = vec![format!("{name}: {}", self.verdict_in_words())];
        let checks = (!self.checks.is_empty()).then(|| counted(self.checks.len(), "check"));
        let duration = self.duration_s.map(|seconds| quantity(seconds, "s"));
        let made = run.map(|run| format!("recorded with congruent {}", run.versions.congruent));
        let further: Vec<String> = [checks, duration, made].into_iter().flatten().collect();
        if !further.is_empty() {
            parts.push(further.join(", "));
        }
        parts.join("; ")
    }

    /// The verdict by the exit code, which also knows what is wrong with the file or has changed since the run.
    fn verdict_in_words(&self) -> String {
        let verdict = match self.exit_code {
            0 => Verdict::AsExpected,
            1 => Verdict::NotAsExpected,
            3 => Verdict::Broken,
            2 => return format!("BAD RECORDING: {}", self.reason),
            _ if self.run.as_ref().is_some_and(|run| run.verdict == Verdict::NotEnoughCases) => {
                Verdict::NotEnoughCases
            }
            _ => return format!("NOT CHECKED: {}", self.reason),
        };
        verdict_line(verdict, &self.reason)
    }
}

/// A check of the recorded run.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CheckSummary {
    /// Kind of the check, such as `clearance`.
    pub check: String,
    /// Result of the check: `pass`, `fail`, `error`, `skipped` or `inconclusive`.
    pub status: String,
    /// Its quantities that have a value, each with the worst one.
    pub quantities: Vec<QuantitySummary>,
}

/// The worst value of a quantity that a check has watched.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct QuantitySummary {
    /// Name of the quantity, such as `position`.
    #[schemars(with = "String")]
    pub quantity: Quantity,
    /// SI unit of limits and values; empty if they have none.
    #[schemars(with = "String")]
    pub unit: SiUnit,
    /// On which side of the limit it must be.
    pub bound: Bound,
    /// Limit of the quantity, in `unit`.
    pub limit: f64,
    /// The worst value; `null` for infinity.
    #[schemars(with = "Option<f64>")]
    pub worst: f64,
    /// Simulated time of the worst value. Unit: s.
    pub worst_s: f64,
    /// The link, joint or pair that it is about.
    pub subject: Option<String>,
}

impl From<&CheckResult> for CheckSummary {
    fn from(result: &CheckResult) -> Self {
        let quantity = |measure: &Measure| {
            let worst = measure.worst.as_ref()?;
            Some(QuantitySummary {
                quantity: measure.quantity,
                unit: measure.unit,
                bound: measure.bound,
                limit: measure.limit,
                worst: worst.value,
                worst_s: worst.time_s,
                subject: Some(worst.subject.clone()),
            })
        };
        Self {
            check: result.check.word().to_owned(),
            status: result.status.word().to_owned(),
            quantities: result.measures.iter().filter_map(quantity).collect(),
        }
    }
}

/// A timeline and its range.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TimelineSummary {
    /// Name of the timeline, such as `sim_time`.
    pub name: String,
    /// `duration` or `timestamp`, both in nanoseconds, or `sequence`.
    pub kind: &'static str,
    /// The first time on it.
    pub first: i64,
    /// The last time on it.
    pub last: i64,
}

/// The rows of one entity.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct EntitySummary {
    /// Its path; special characters in names are escaped with a backslash.
    pub path: String,
    /// Its components, by name.
    pub components: Vec<String>,
    /// Number of rows in all chunks.
    pub rows: u64,
    /// Number of chunks, in which the file stores its rows.
    pub chunks: u64,
}

/// Statistics of one scalar over time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ScalarSummary {
    /// Path of its entity.
    pub path: String,
    /// Number of values, those that are NaN included.
    pub count: u64,
    /// Number of NaN among them.
    pub nan: u64,
    /// The smallest value that is not NaN.
    pub min: Option<f64>,
    /// The largest value that is not NaN.
    pub max: Option<f64>,
    /// The value at the last time.
    pub last: Option<f64>,
}
