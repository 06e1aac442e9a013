//! How far a sweep is: the answer of `congruent sweep status`, and of a part of `sweep run`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::{header::SweepHeader, merged::MergedTable};
use crate::run::CaseVerdict;

/// How far a sweep is.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweepProgress {
    /// What the rows are of.
    pub header: SweepHeader,
    /// The folder, as it was named.
    pub folder: String,
    /// Number of cases that ran in this call.
    pub ran: u64,
    /// Number of rows in the folder.
    pub rows: u64,
    /// Number of rows with each verdict.
    pub verdicts: BTreeMap<&'static str, u64>,
    /// The cases of the plan without a row, as ranges `A..B`, without B.
    pub missing: Vec<String>,
    /// Number of these cases.
    pub missing_count: u64,
}

impl SweepProgress {
    /// The progress of a folder with these rows, of which `ran` are of this call.
    pub fn new(table: &MergedTable, folder: String, ran: u64) -> Self {
        Self {
            header: table.header.clone(),
            folder,
            ran,
            rows: table.rows.len() as u64,
            verdicts: verdict_counts(table),
            missing: table.missing.iter().map(ToString::to_string).collect(),
            missing_count: table.missing_count(),
        }
    }
}

/// Number of rows with each verdict that occurs.
pub(crate) fn verdict_counts(table: &MergedTable) -> BTreeMap<&'static str, u64> {
    let count = |verdict: CaseVerdict| table.rows.iter().filter(|row| row.verdict == verdict).count() as u64;
    let counts = CaseVerdict::ALL.map(|verdict| (verdict.word(), count(verdict)));
    counts.into_iter().filter(|(_, count)| *count > 0).collect()
}
