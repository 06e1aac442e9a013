//! The comparison of two files of one kind.

use congruent_input::serde_name;
use schemars::JsonSchema;
use serde::Serialize;

use super::difference::{SeriesDifference, ValueDifference};

/// A kind of file that can be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ComparedFile {
    /// The reports of two runs, `report.json`.
    Report,
    /// Tables of two runs, `trajectory.csv` or `trajectory.parquet`.
    Trajectory,
    /// Recordings of two runs, `recording.rrd`.
    Recording,
}

impl std::fmt::Display for ComparedFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(serde_name(self))
    }
}

/// What two files of one kind have in common, and what not.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FileComparison {
    /// Kind of the two files.
    pub kind: ComparedFile,
    /// Whether nothing differs beyond the tolerance.
    pub same: bool,
    /// Number of series, or of values of a report, that both have.
    pub compared: usize,
    /// What differs as a whole: robots, lengths, hashes of the trajectories.
    pub statements: Vec<String>,
    /// The first difference in time; of several at one time that of the first joint, from which poses and errors follow.
    pub first: Option<ValueDifference>,
    /// Every series that differs, in the order of A.
    pub series: Vec<SeriesDifference>,
    /// Series or values that only A has.
    pub only_in_a: Vec<String>,
    /// Series or values that only B has.
    pub only_in_b: Vec<String>,
}

impl FileComparison {
    /// The comparison of some series of which those that differ are given; statements are differences.
    pub(super) fn new(
        kind: ComparedFile,
        compared: usize,
        series: Vec<SeriesDifference>,
        [only_in_a, only_in_b]: [Vec<String>; 2],
        statements: Vec<String>,
    ) -> Self {
        let time_s = |difference: &ValueDifference| difference.time_s.unwrap_or(f64::INFINITY);
        let follows = |difference: &ValueDifference| difference.joint.is_none();
        let firsts = series.iter().filter_map(|series| series.first.as_ref());
        let first =
            firsts.min_by(|a, b| time_s(a).total_cmp(&time_s(b)).then(follows(a).cmp(&follows(b)))).cloned();
        let same = series.is_empty() && only_in_a.is_empty() && only_in_b.is_empty() && statements.is_empty();
        Self { kind, same, compared, statements, first, series, only_in_a, only_in_b }
    }
}
