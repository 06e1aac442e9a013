//! Two reports, value beside value. Whatever a report has or will have is compared, except for what names its files.

use std::path::Path;

use serde_json::{Map, Value as Json};

use super::{
    file_comparison::{ComparedFile, FileComparison},
    report_label::ReportLabel,
    series::{SAME_TIME_S, SeriesComparison, is_compared},
};
use crate::trajectory_file::Value;

/// Keys that say where a run was and how its files were written, not what it found.
const LEFT_OUT: [&str; 4] = ["scenario_file", "inputs", "overrides", "warnings"];
/// The key of the line of a check or of a finding.
const LINE: &str = "line";
/// The key of a check that the scenario does not have.
const DEFAULT: &str = "default";
/// The key of the trajectory's hash.
const HASH: &str = "trajectory_sha256";

/// A value of a report that has no values below it.
struct Leaf<'a> {
    /// Its keys, joined by dots; entries of lists from 1.
    keys: String,
    value: &'a Json,
    /// The time of the moment that it belongs to.
    time_s: Option<f64>,
}

/// Compares the documents of two runs.
///
/// # Errors
/// What a file is instead of a report.
pub fn compare_reports(a: &Path, b: &Path, tolerance: f64) -> Result<FileComparison, String> {
    let [a, b] = [read(a)?, read(b)?];
    let [leaves_a, leaves_b] = [&a, &b].map(|report| {
        let mut leaves = Vec::new();
        for (key, value) in report.iter().filter(|(key, _)| !LEFT_OUT.contains(&key.as_str())) {
            gather(value, key.clone(), None, &mut leaves);
        }
        leaves.sort_by(|a: &Leaf<'_>, b| a.keys.cmp(&b.keys));
        leaves
    });
    let find =
        |leaves: &[Leaf<'_>], keys: &str| leaves.binary_search_by(|leaf| leaf.keys.as_str().cmp(keys)).ok();
    let missing = |from: &[Leaf<'_>], to: &[Leaf<'_>]| -> Vec<String> {
        from.iter().filter(|leaf| find(to, &leaf.keys).is_none()).map(|leaf| leaf.keys.clone()).collect()
    };
    let only_in = [missing(&leaves_a, &leaves_b), missing(&leaves_b, &leaves_a)];
    let (mut compared, mut differences) = (0, Vec::new());
    for leaf in &leaves_a {
        // The hash has a sentence of its own, since it is no value that could be within a tolerance.
        let is_compared = leaf.keys != HASH && is_compared(&leaf.keys, tolerance);
        let Some(other) = find(&leaves_b, &leaf.keys).filter(|_| is_compared) else { continue };
        compared += 1;
        let mut series = SeriesComparison::new(&leaf.keys, joint(&leaf.keys), tolerance)
            .labelled(ReportLabel::new(&a, &leaf.keys));
        let other = &leaves_b[other];
        // Moments of other times are two moments: the difference has none.
        let is_same = |(a, b): (f64, f64)| (a - b).abs() <= SAME_TIME_S;
        let time_s = leaf.time_s.filter(|&a| other.time_s.is_some_and(|b| is_same((a, b))));
        series.observe(time_s, &value(leaf.value), &value(other.value));
        differences.extend(series.finish());
    }
    let statements = statements(&a, &b, tolerance);
    Ok(FileComparison::new(ComparedFile::Report, compared, differences, only_in, statements))
}

fn read(path: &Path) -> Result<Map<String, Json>, String> {
    let refused = |why: String| format!("{} is not a report of a run: {why}", path.display());
    let text = std::fs::read_to_string(path).map_err(|error| refused(error.to_string()))?;
    let report: Json = serde_json::from_str(&text).map_err(|error| refused(error.to_string()))?;
    match report {
        Json::Object(report) if report.contains_key(HASH) => Ok(report),
        _ => Err(refused(format!("it has no {HASH}"))),
    }
}

/// All values below `value`, which has these keys.
fn gather<'a>(value: &'a Json, keys: String, time_s: Option<f64>, leaves: &mut Vec<Leaf<'a>>) {
    match value {
        Json::Object(entries) if !entries.is_empty() => {
            let time_s = entries.get("time_s").and_then(Json::as_f64).or(time_s);
            for (key, value) in entries.iter().filter(|(key, value)| !is_of_file(key, value)) {
                gather(value, format!("{keys}.{key}"), time_s, leaves);
            }
        }
        Json::Array(entries) if !entries.is_empty() => {
            for (index, value) in entries.iter().enumerate() {
                gather(value, format!("{keys}.{}", index + 1), time_s, leaves);
            }
        }
        _ => leaves.push(Leaf { keys, value, time_s }),
    }
}

fn value(json: &Json) -> Value {
    match json {
        Json::Null => Value::Missing,
        Json::Number(number) => {
            number.as_f64().map_or_else(|| Value::Name(number.to_string()), Value::Number)
        }
        Json::String(text) => Value::Name(text.clone()),
        other => Value::Name(other.to_string()),
    }
}

/// The joint of a configuration's entry, `checks.1.measures.1.worst.q.JOINT`.
fn joint(keys: &str) -> Option<String> {
    let (_, joint) = keys.split_once(".q.")?;
    Some(joint.to_owned())
}

/// Statements about the two runs as a whole: robots, versions, hashes. Without a tolerance, different hashes are a difference.
fn statements(a: &Map<String, Json>, b: &Map<String, Json>, tolerance: f64) -> Vec<String> {
    let mut statements = Vec::new();
    let text = |report: &Map<String, Json>, key: &str| {
        report.get(key).map_or_else(
            || "none".to_owned(),
            |value| value.as_str().map_or_else(|| value.to_string(), str::to_owned),
        )
    };
    for (key, what) in [("scenario", "two scenarios"), ("verdict", "two verdicts")] {
        if a.get(key) != b.get(key) {
            statements.push(format!("{what}: {} in A, {} in B", text(a, key), text(b, key)));
        }
    }
    if a.get("robot") != b.get("robot") {
        statements.push(format!("the robots differ: {} in A, {} in B", text(a, "robot"), text(b, "robot")));
    }
    if a.get(HASH) != b.get(HASH) && tolerance <= 0.0 {
        statements.push("the trajectories differ: their hashes are not equal".to_owned());
    }
    statements
}

/// Whether a value says how a check is written: its line, or that it is written nowhere, as a default one.
fn is_of_file(key: &str, value: &Json) -> bool {
    key == LINE || key == DEFAULT && value.is_boolean()
}
