//! The answer of `congruent sweep merge`: what all rows of a sweep show.

use std::collections::BTreeMap;

use congruent_results::report::{KeyImportance, PassingShare, RequirementResult};
use congruent_scenario::CaseSampling;
use schemars::JsonSchema;
use serde::Serialize;

use super::importance::importance;
use crate::{
    run::{CaseRow, CaseVerdict},
    store::{MergedTable, SweepHeader, number, table_sha256, verdict_counts},
};

/// Values that differ by less are one, relative. Kind: rounding.
const ROUNDING: f64 = 1e-9;
/// Most cases that are listed with the reason for which they were refused.
const MOST_REFUSED: usize = 10;

/// What the rows of a sweep show.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepSummary {
    /// What the rows are of.
    pub header: SweepHeader,
    /// Number of rows.
    pub rows: u64,
    /// Number of cases of the plan without a row.
    pub missing: u64,
    /// SHA-256 over the rows: equal however the sweep was cut, and whichever machine ran which part.
    pub table_sha256: String,
    /// Number of cases with each verdict.
    pub verdicts: BTreeMap<&'static str, u64>,
    /// The answer to `[require]` of the plan; left out if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub requirement: Option<RequirementResult>,
    /// The quantities of the checks that vary, those with the smallest margin first.
    pub measures: Vec<MeasureSummary>,
    /// The cases with the smallest margins, the worst first.
    pub worst: Vec<SmallestMargin>,
    /// The first cases that could not be run, with the reason.
    pub refused: BTreeMap<u64, String>,
}

/// One quantity of a check over all cases.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeasureSummary {
    /// Its name: check, quantity, unit.
    pub name: String,
    /// The least, the median and the largest of its worst values.
    pub range: [f64; 3],
    /// The smallest margin, as a share of the limit.
    pub least_margin: f64,
    /// The case that has it.
    pub least_case: u64,
    /// Number of cases whose value is outside of the limit.
    pub outside: u64,
    /// The varied keys, the one that decides most first. Empty for fewer than 40 cases.
    pub importance: Vec<KeyImportance>,
}

/// A case with a small margin.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SmallestMargin {
    /// Its number.
    pub case: u64,
    /// Its values, in the order of the keys, as TOML.
    pub values: Vec<String>,
    /// Its verdict.
    pub verdict: CaseVerdict,
    /// The quantity with the smallest margin.
    pub quantity: String,
    /// The value of the quantity.
    pub value: Option<f64>,
    /// Its limit.
    pub limit: f64,
    /// Its margin as a share of the limit.
    pub margin_share: f64,
    /// What the samples show to be wrong, if a check failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// The page of the case that was run again, from the folder of the sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub page: Option<String>,
}

impl SweepSummary {
    /// The summary of rows, judged by the requirement of their plan, with so many of the worst cases.
    pub fn new(table: &MergedTable, require: Option<PassingShare>, worst: usize) -> Self {
        let rows = &table.rows;
        let refused = rows.iter().filter_map(|row| Some((row.case, row.error.clone()?)));
        Self {
            header: table.header.clone(),
            rows: rows.len() as u64,
            missing: table.missing_count(),
            table_sha256: table_sha256(rows),
            verdicts: verdict_counts(table),
            requirement: require
                .map(|require| RequirementResult::new(require, passed(rows), rows.len() as u64)),
            measures: measures(table),
            worst: worst_cases(rows, worst),
            refused: refused.take(MOST_REFUSED).collect(),
        }
    }
}

/// Number of cases that passed. A case that broke or could not be run has not.
fn passed(rows: &[CaseRow]) -> u64 {
    rows.iter().filter(|row| row.verdict == CaseVerdict::Pass).count() as u64
}

fn worst_cases(rows: &[CaseRow], count: usize) -> Vec<SmallestMargin> {
    let mut worst: Vec<SmallestMargin> = rows
        .iter()
        .filter(|row| row.verdict != CaseVerdict::Broken)
        .filter_map(|row| {
            let (quantity, margin_share) = row.least_margin()?;
            let of = row.worst.get(quantity)?;
            Some(SmallestMargin {
                case: row.case,
                values: row.values.clone(),
                verdict: row.verdict,
                quantity: quantity.to_owned(),
                value: of.value,
                limit: of.limit,
                margin_share,
                cause: row.cause.clone(),
                page: None,
            })
        })
        .collect();
    // Of equal margins the first case, so that the list does not depend on the order of the rows.
    worst.sort_by(|a, b| a.margin_share.total_cmp(&b.margin_share).then(a.case.cmp(&b.case)));
    worst.truncate(count);
    worst
}

fn measures(table: &MergedTable) -> Vec<MeasureSummary> {
    let mut columns: BTreeMap<&str, Vec<&CaseRow>> = BTreeMap::new();
    // A run that broke was not checked to its end.
    for row in table.rows.iter().filter(|row| row.verdict != CaseVerdict::Broken) {
        row.worst.keys().for_each(|name| columns.entry(name).or_default().push(row));
    }
    let mut measures: Vec<MeasureSummary> =
        columns.into_iter().filter_map(|(name, rows)| measure(table, name, &rows)).collect();
    measures.sort_by(|a, b| a.least_margin.total_cmp(&b.least_margin).then(a.name.cmp(&b.name)));
    measures
}

/// A quantity over the rows that have it; `None` if it is the same in all.
fn measure(table: &MergedTable, name: &str, rows: &[&CaseRow]) -> Option<MeasureSummary> {
    let of = |row: &CaseRow| row.worst.get(name).copied();
    let value = |row: &CaseRow| of(row).and_then(|worst| worst.value);
    let mut sorted: Vec<f64> = rows.iter().filter_map(|row| value(row)).collect();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let median = f64::midpoint(sorted[middle.min(sorted.len() - 1)], sorted[(sorted.len() - 1) / 2]);
    let range = [*sorted.first()?, median, *sorted.last()?];
    // Rounding of one value is no variation.
    if sorted.len() > 1 && range[2] - range[0] <= ROUNDING * range[0].abs().max(range[2].abs()) {
        return None;
    }
    let margins = rows.iter().filter_map(|row| Some((row.case, of(row)?.margin_share()?)));
    let (least_case, least_margin) = margins.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))?;
    let outside = rows.iter().filter(|row| of(row).is_some_and(|worst| worst.is_outside));
    let quantity: Vec<f64> = rows.iter().map(|row| value(row).unwrap_or(f64::NAN)).collect();
    let importance = importances(&table.header.keys, table.header.sampling, rows, &quantity);
    Some(MeasureSummary {
        name: name.to_owned(),
        range,
        least_margin,
        least_case,
        outside: outside.count() as u64,
        importance,
    })
}

/// The importance of each key for a quantity of these rows, the one that decides most first.
pub(crate) fn importances(
    keys: &[String],
    sampling: CaseSampling,
    rows: &[&CaseRow],
    quantity: &[f64],
) -> Vec<KeyImportance> {
    let of_key = |(at, key): (usize, &String)| {
        let (values, are_numbers) = key_values(rows, at);
        let found = importance(key, &values, quantity, sampling)?;
        // Words have no more and less.
        Some(if are_numbers { found } else { KeyImportance { rank_correlation: 0.0, ..found } })
    };
    let mut importances: Vec<KeyImportance> = keys.iter().enumerate().filter_map(of_key).collect();
    importances.sort_by(|a, b| b.share.total_cmp(&a.share).then(a.key.cmp(&b.key)));
    importances
}

/// The values of a key as numbers, and whether they are some: of words, the place of each in their order.
fn key_values(rows: &[&CaseRow], at: usize) -> (Vec<f64>, bool) {
    let numbers: Option<Vec<f64>> = rows.iter().map(|row| number(&row.values[at])).collect();
    if let Some(numbers) = numbers {
        return (numbers, true);
    }
    let mut words: Vec<&str> = rows.iter().map(|row| row.values[at].as_str()).collect();
    words.sort_unstable();
    words.dedup();
    let place = |word: &str| words.binary_search(&word).unwrap_or(0);
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 words")]
    let places = rows.iter().map(|row| place(&row.values[at]) as f64).collect();
    (places, false)
}
