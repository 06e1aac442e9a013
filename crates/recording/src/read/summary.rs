//! The result of [`inspect`](super::inspect): ordered lists, as text for people and as JSON.

use std::{collections::BTreeMap, fmt};

use schemars::JsonSchema;
use serde::Serialize;

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
    /// Whether the file ends with its footer; otherwise it was cut off or the recording was not finished.
    pub complete: bool,
    /// Problems with the file or its values.
    pub problems: Vec<String>,
    /// The run's verdict, if this program made the recording.
    pub verdict: Option<String>,
    /// The exit code of `inspect`: that of the run, 2 if the file is cut off or has problems, 4 without a verdict.
    pub exit_code: u8,
    /// Why it is that one.
    pub reason: String,
    /// Whether the file contains a layout for the viewer.
    pub has_layout: bool,
    /// Timelines, by name.
    pub timelines: Vec<TimelineSummary>,
    /// Entities, by path.
    pub entities: Vec<EntitySummary>,
    /// Scalars over time, by path.
    pub scalars: Vec<ScalarSummary>,
    /// Properties of the recording, by name.
    pub properties: BTreeMap<String, serde_json::Value>,
    /// The report of the run, if this program made the recording.
    pub report: Option<serde_json::Value>,
}

/// A timeline and its range.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TimelineSummary {
    /// Its name.
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
    /// Number of chunks.
    pub chunks: u64,
}

/// Statistics of one scalar over time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ScalarSummary {
    /// Path of its entity.
    pub path: String,
    /// Number of values.
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

impl TimelineSummary {
    #[expect(clippy::cast_precision_loss, reason = "shown with a few digits")]
    fn seconds(&self) -> (f64, f64) {
        (self.first as f64 * 1e-9, self.last as f64 * 1e-9)
    }
}

/// The archetypes of components that are sorted by name, each once.
fn archetypes(components: &[String]) -> Vec<&str> {
    let mut archetypes: Vec<_> =
        components.iter().map(|name| name.split(':').next().unwrap_or(name)).collect();
    archetypes.dedup();
    archetypes
}

impl fmt::Display for RecordingSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "application: {}", self.application_id)?;
        writeln!(f, "recording: {}", self.recording_id)?;
        let state = if self.complete { "complete" } else { "incomplete" };
        writeln!(f, "file: {} bytes, {state}", self.bytes)?;
        writeln!(f, "verdict: {}", self.verdict.as_deref().unwrap_or("none"))?;
        writeln!(f, "reason: {}", self.reason)?;
        for problem in &self.problems {
            writeln!(f, "problem: {problem}")?;
        }
        for (name, value) in self.properties.iter().filter(|(name, _)| *name != VERDICT) {
            writeln!(f, "property {name}: {value}")?;
        }
        for timeline in &self.timelines {
            if timeline.kind == "duration" {
                let (first, last) = timeline.seconds();
                writeln!(f, "timeline {}: {first:.3} s to {last:.3} s", timeline.name)?;
            } else {
                writeln!(f, "timeline {}: {} to {}", timeline.name, timeline.first, timeline.last)?;
            }
        }
        let longest = |paths: &mut dyn Iterator<Item = &String>| paths.map(|path| path.chars().count()).max();
        let width = longest(&mut self.entities.iter().map(|entity| &entity.path)).unwrap_or(0).min(60);
        writeln!(f, "\n{:<width$}  {:>7}  archetypes", "entity", "rows")?;
        for EntitySummary { path, components, rows, .. } in &self.entities {
            writeln!(f, "{path:<width$}  {rows:>7}  {}", archetypes(components).join(", "))?;
        }
        let width = longest(&mut self.scalars.iter().map(|scalar| &scalar.path)).unwrap_or(0).min(60);
        let number =
            |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.6e}"));
        writeln!(f, "\n{:<width$}  {:>7}  {:>13}  {:>13}  {:>13}", "scalar", "count", "min", "max", "last")?;
        for scalar in &self.scalars {
            let [min, max, last] = [scalar.min, scalar.max, scalar.last].map(number);
            writeln!(f, "{:<width$}  {:>7}  {min:>13}  {max:>13}  {last:>13}", scalar.path, scalar.count)?;
        }
        Ok(())
    }
}
