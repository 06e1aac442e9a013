//! The content of a file, gathered from its messages.

use std::collections::{BTreeMap, BTreeSet};

use congruent_input::display::quantity;
use congruent_results::report::RunReport;
use re_chunk::{
    Chunk, TimeColumn,
    external::arrow::{
        array::{Array, AsArray},
        datatypes::{DataType, Float32Type, Float64Type, UInt64Type},
    },
};
use re_log_types::{ArrowMsg, EntityPathPart, StoreId, TimeType};
use re_sdk_types::archetypes::Scalars;
use serde::Deserialize;
use serde_json::Value;

use super::summary::{
    CheckSummary, EntitySummary, RecordingSummary, ScalarSummary, TimelineSummary, VERDICT,
};
use crate::rrd::{identity, times::seconds};

/// The property that holds the whole report.
const REPORT: &str = "congruent/report";
/// The most levels of nested Arrow lists that are read: more than any component has.
const MAX_DEPTH: usize = 16;

#[derive(Debug, Default)]
struct EntityContent {
    components: BTreeSet<String>,
    rows: u64,
    chunks: u64,
    nan: u64,
}

#[derive(Debug, Default)]
struct ScalarStatistics {
    count: u64,
    nan: u64,
    min: Option<f64>,
    max: Option<f64>,
    last: Option<(i64, f64)>,
    /// The first time that is earlier than one before it in the file.
    backwards: Option<i64>,
}

impl ScalarStatistics {
    fn add(&mut self, time: i64, value: f64) {
        self.count += 1;
        if self.backwards.is_none() && self.last.is_some_and(|(known, _)| time < known) {
            self.backwards = Some(time);
        }
        // Of equal times the later in the file.
        if self.last.is_none_or(|(known, _)| known <= time) {
            self.last = Some((time, value));
        }
        if value.is_nan() {
            // NaN is counted and not compared: it would make both extremes NaN.
            self.nan += 1;
        } else {
            self.min = Some(self.min.map_or(value, |known| known.min(value)));
            self.max = Some(self.max.map_or(value, |known| known.max(value)));
        }
    }
}

/// What the messages so far contain. Of several recordings in one file, only the first is read.
#[derive(Debug, Default)]
pub(super) struct RecordingContent {
    recording: Option<StoreId>,
    others: BTreeSet<String>,
    has_layout: bool,
    timelines: BTreeMap<String, TimelineSummary>,
    entities: BTreeMap<String, EntityContent>,
    scalars: BTreeMap<String, ScalarStatistics>,
    properties: BTreeMap<String, Value>,
    problems: Vec<String>,
    /// The entity of the last chunk, and its last time in nanoseconds.
    last_chunk: Option<(String, Option<i64>)>,
    /// All values of each scalar with their times, if the caller wants them.
    pub(super) series: Option<BTreeMap<String, Vec<(i64, f64)>>>,
}

impl RecordingContent {
    /// Adds a recording or a layout.
    pub(super) fn add_store(&mut self, store: &StoreId) {
        if store.is_blueprint() {
            self.has_layout = true;
        // The first recording of the file is the one that counts. Files put together hold more; mixing their samples
        // would show a run that never was.
        } else if self.recording.as_ref().is_none_or(|known| known == store) {
            self.recording = Some(store.clone());
        } else {
            self.others.insert(store.recording_id().to_string());
        }
    }

    /// The entity of the last chunk, and its last time: where a reader is in the file.
    pub(super) fn last_chunk(&self) -> Option<String> {
        let (entity, time) = self.last_chunk.as_ref()?;
        let time = time.map(|time| format!(" at {}", quantity(seconds(time), "s")));
        Some(format!("{entity}{}", time.unwrap_or_default()))
    }

    /// Adds a chunk; the error says why it cannot be read.
    pub(super) fn add_chunk(&mut self, store: &StoreId, message: &ArrowMsg) -> Result<(), String> {
        self.add_store(store);
        if self.recording.as_ref() != Some(store) {
            return Ok(());
        }
        let chunk = Chunk::from_arrow_msg(message).map_err(|error| error.to_string())?;
        for (name, column) in chunk.timelines() {
            self.add_times(name.as_str(), column.timeline().typ(), column.times_raw());
        }
        if chunk.entity_path().is_property() {
            self.add_properties(&chunk);
            return Ok(());
        }
        let path = chunk.entity_path().to_string();
        let times =
            chunk.timelines().values().filter(|column| column.timeline().typ() == TimeType::DurationNs);
        self.last_chunk = Some((path.clone(), times.flat_map(TimeColumn::times_raw).max().copied()));
        let entity = self.entities.entry(path.clone()).or_default();
        entity.chunks += 1;
        entity.rows += chunk.num_rows() as u64;
        let scalars = Scalars::descriptor_scalars().component;
        for column in chunk.components().values() {
            entity.components.insert(column.descriptor.component.to_string());
            // NaN among scalars are counted by `add_scalars`, with their statistics.
            if column.descriptor.component != scalars {
                entity.nan += count_nan(column.list_array.values(), 0);
            }
        }
        self.add_scalars(&path, &chunk);
        Ok(())
    }

    fn add_times(&mut self, name: &str, kind: TimeType, times: &[i64]) {
        let (Some(&first), Some(&last)) = (times.iter().min(), times.iter().max()) else { return };
        let kind = match kind {
            TimeType::Sequence => "sequence",
            TimeType::DurationNs => "duration",
            TimeType::TimestampNs => "timestamp",
        };
        let new = || TimelineSummary { name: name.to_owned(), kind, first, last };
        let timeline = self.timelines.entry(name.to_owned()).or_insert_with(new);
        (timeline.first, timeline.last) = (timeline.first.min(first), timeline.last.max(last));
    }

    fn add_scalars(&mut self, path: &str, chunk: &Chunk) {
        let Some(rows) = chunk.components().get_array(Scalars::descriptor_scalars().component) else {
            return;
        };
        let timelines = chunk.timelines().iter();
        // A timeline of times before one of counts, then by name: the same choice for each chunk of an entity.
        let is_counted = |kind: TimeType| kind == TimeType::Sequence;
        let first_timeline =
            timelines.min_by_key(|(name, column)| (is_counted(column.timeline().typ()), name.as_str()));
        let times = first_timeline.map_or(&[][..], |(_, column)| column.times_raw());
        let scalar = self.scalars.entry(path.to_owned()).or_default();
        for row in (0..rows.len()).filter(|&row| rows.is_valid(row)) {
            // Values without a time hold always: the earliest time sorts them before all others.
            let time = times.get(row).copied().unwrap_or(i64::MIN);
            if let Some(values) = rows.value(row).as_primitive_opt::<Float64Type>() {
                values.iter().flatten().for_each(|value| scalar.add(time, value));
                if let Some(series) = &mut self.series {
                    let series = series.entry(path.to_owned()).or_default();
                    series.extend(values.iter().flatten().map(|value| (time, value)));
                }
            }
        }
    }

    fn add_properties(&mut self, chunk: &Chunk) {
        let parts: Vec<_> = chunk.entity_path().iter().skip(1).map(EntityPathPart::unescaped_str).collect();
        for column in chunk.components().values() {
            let component = column.descriptor.component.to_string();
            let name = parts.iter().copied().chain([component.as_str()]).collect::<Vec<_>>().join("/");
            if let Some(value) = first_value(column.list_array.values()) {
                self.properties.insert(name, value);
            }
        }
    }

    /// The summary, except for the file's size and completeness; `None` without a recording.
    pub(super) fn summary(&mut self) -> Option<RecordingSummary> {
        let recording = self.recording.as_ref()?;
        let (application_id, recording_id) =
            (recording.application_id().as_str().to_owned(), recording.recording_id().to_string());
        // Before scalars and entities are moved into the summary.
        self.find_problems();
        let report = self.properties.remove(REPORT);
        let report: Option<Value> = report.and_then(|text| serde_json::from_str(text.as_str()?).ok());
        let run = report.as_ref().map(RunReport::deserialize).transpose();
        let run = run.unwrap_or_else(|error| {
            self.problems.push(format!("{REPORT}: {error}"));
            None
        });
        let verdict = self.properties.get(VERDICT).and_then(Value::as_str).map(str::to_owned);
        let entity = |(path, entity): (String, EntityContent)| EntitySummary {
            path,
            components: entity.components.into_iter().collect(),
            rows: entity.rows,
            chunks: entity.chunks,
        };
        let scalar = |(path, scalar): (String, ScalarStatistics)| ScalarSummary {
            path,
            count: scalar.count,
            nan: scalar.nan,
            min: scalar.min,
            max: scalar.max,
            last: scalar.last.map(|(_, value)| value),
        };
        Some(RecordingSummary {
            format: "congruent-recording-summary/2",
            application_id,
            recording_id,
            bytes: 0,
            complete: false,
            problems: std::mem::take(&mut self.problems),
            verdict,
            exit_code: 0,
            reason: String::new(),
            duration_s: self.duration_s(),
            checks: run.iter().flat_map(|run| run.checks.iter().map(CheckSummary::from)).collect(),
            changed_inputs: None,
            missing_results: Vec::new(),
            recheck: None,
            has_layout: self.has_layout,
            timelines: std::mem::take(&mut self.timelines).into_values().collect(),
            entities: std::mem::take(&mut self.entities).into_iter().map(entity).collect(),
            scalars: std::mem::take(&mut self.scalars).into_iter().map(scalar).collect(),
            properties: std::mem::take(&mut self.properties),
            report,
            run,
        })
    }

    fn duration_s(&self) -> Option<f64> {
        let mut timelines = self.timelines.values();
        let timeline = timelines.find(|timeline| timeline.kind != "sequence")?;
        Some(seconds(timeline.last) - seconds(timeline.first))
    }

    fn find_problems(&mut self) {
        for (path, scalar) in self.scalars.iter().filter(|(_, scalar)| scalar.nan > 0) {
            self.problems.push(format!("{path}: {} of {} values are NaN", scalar.nan, scalar.count));
        }
        // Other programs may log as they like; this one writes each series in order of time.
        let is_ours =
            self.recording.as_ref().is_some_and(|store| identity::is_application(store.application_id()));
        for (path, scalar) in self.scalars.iter().filter(|_| is_ours) {
            if let Some(nanoseconds) = scalar.backwards {
                self.problems.push(format!(
                    "{path}: the times are not in order, the value at {} comes after later ones",
                    quantity(seconds(nanoseconds), "s")
                ));
            }
        }
        for (path, entity) in self.entities.iter().filter(|(_, entity)| entity.nan > 0) {
            self.problems.push(format!("{path}: {} values are NaN", entity.nan));
        }
        for other in &self.others {
            self.problems
                .push(format!("the file contains another recording, which is not summarised: {other}"));
        }
    }
}

/// Number of NaN in nested lists.
fn count_nan(array: &dyn Array, depth: usize) -> u64 {
    // A file can nest lists as deep as it likes; the recursion must end before the stack does.
    if depth > MAX_DEPTH {
        return 0;
    }
    let inside = |values: &dyn Array| count_nan(values, depth + 1);
    let count = |are_nan: &mut dyn Iterator<Item = bool>| are_nan.filter(|&is_nan| is_nan).count() as u64;
    match array.data_type() {
        DataType::Float32 => {
            count(&mut array.as_primitive::<Float32Type>().iter().flatten().map(f32::is_nan))
        }
        DataType::Float64 => {
            count(&mut array.as_primitive::<Float64Type>().iter().flatten().map(f64::is_nan))
        }
        DataType::List(_) => inside(array.as_list::<i32>().values()),
        DataType::FixedSizeList(..) => inside(array.as_fixed_size_list().values()),
        DataType::Struct(_) => array.as_struct().columns().iter().map(|column| inside(column)).sum(),
        _ => 0,
    }
}

/// The first value of a property, if it is text or a number.
fn first_value(array: &dyn Array) -> Option<Value> {
    if array.is_empty() || array.is_null(0) {
        return None;
    }
    match array.data_type() {
        DataType::Utf8 => Some(array.as_string::<i32>().value(0).into()),
        DataType::UInt64 => Some(array.as_primitive::<UInt64Type>().value(0).into()),
        DataType::Float64 => Some(array.as_primitive::<Float64Type>().value(0).into()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use re_chunk::external::arrow::array::{FixedSizeListArray, Float32Array, ListArray};

    use super::*;

    #[test]
    fn nan_is_found_in_nested_lists() {
        let points = [Some([1.0, f32::NAN, 3.0]), Some([f32::NAN, f32::INFINITY, 0.0]), None];
        let points = points.map(|point| point.map(|point| point.map(Some)));
        let list = FixedSizeListArray::from_iter_primitive::<Float32Type, _, _>(points, 3);
        assert_eq!(count_nan(&list, 0), 2);
        let rows = [Some(vec![Some(f64::NAN), None]), None];
        assert_eq!(count_nan(&ListArray::from_iter_primitive::<Float64Type, _, _>(rows), 0), 1);
        assert_eq!(
            count_nan(&Float32Array::from(vec![f32::NAN]), MAX_DEPTH + 1),
            0,
            "lists are read up to the maximum depth"
        );
    }

    #[test]
    fn statistics_leave_out_nan() {
        let mut scalar = ScalarStatistics::default();
        for (time, value) in [(0, 2.0), (2, -1.0), (1, f64::NAN)] {
            scalar.add(time, value);
        }
        assert_eq!((scalar.count, scalar.nan), (3, 1));
        assert_eq!((scalar.min, scalar.max, scalar.last), (Some(-1.0), Some(2.0), Some((2, -1.0))));
    }
}
