//! What [`inspect`](super::inspect) gives: ordered lists, ready for people and for JSON.

use std::{collections::BTreeMap, fmt};

use serde::Serialize;

/// What a recording holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordingSummary {
    /// Name and version of this format.
    pub format: &'static str,
    /// The application that made the recording.
    pub application_id: String,
    /// The recording.
    pub recording_id: String,
    /// Size of the file.
    pub bytes: u64,
    /// Whether the file ends with its footer; one that does not was cut off or is not finished.
    pub complete: bool,
    /// What is wrong with the file or its figures; empty where nothing is.
    pub problems: Vec<String>,
    /// The run's verdict, where the recording is one of this program.
    pub verdict: Option<String>,
    /// Whether a layout for the viewer is inside.
    pub has_layout: bool,
    /// Timelines, by name.
    pub timelines: Vec<TimelineSummary>,
    /// Entities, by path.
    pub entities: Vec<EntitySummary>,
    /// Every scalar that is recorded over time, by path.
    pub scalars: Vec<ScalarSummary>,
    /// Properties of the recording, by name.
    pub properties: BTreeMap<String, serde_json::Value>,
    /// The whole report of the run, where the recording is one of this program.
    pub report: Option<serde_json::Value>,
}

/// A timeline with its range.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TimelineSummary {
    /// Its name.
    pub name: String,
    /// `duration` and `timestamp` count nanoseconds, `sequence` counts.
    pub kind: &'static str,
    /// The first time on it.
    pub first: i64,
    /// The last time on it.
    pub last: i64,
}

/// What is recorded about one entity.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct EntitySummary {
    /// Its path; odd characters in names are escaped with a backslash.
    pub path: String,
    /// Its components, by name.
    pub components: Vec<String>,
    /// Rows in all chunks.
    pub rows: u64,
    /// Chunks.
    pub chunks: u64,
}

/// Figures of one scalar.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalarSummary {
    /// Path of its entity.
    pub path: String,
    /// How many values there are.
    pub count: u64,
    /// How many of them are no number.
    pub nan: u64,
    /// The smallest number.
    pub min: Option<f64>,
    /// The largest number.
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

/// What the components belong to, each once; they are ordered by it.
fn archetypes(components: &[String]) -> Vec<&str> {
    let mut archetypes: Vec<_> =
        components.iter().map(|name| name.split(':').next().unwrap_or(name)).collect();
    archetypes.dedup();
    archetypes
}

impl fmt::Display for RecordingSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "application {}, recording {}", self.application_id, self.recording_id)?;
        let state = if self.complete { "complete" } else { "not complete" };
        writeln!(f, "{} bytes, {state}", self.bytes)?;
        match &self.verdict {
            Some(verdict) => writeln!(f, "verdict {verdict}")?,
            None => writeln!(f, "no verdict inside")?,
        }
        for problem in &self.problems {
            writeln!(f, "problem: {problem}")?;
        }
        for (name, value) in &self.properties {
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
        writeln!(f, "\n{:<width$}  {:>7}  kinds", "entity", "rows")?;
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
