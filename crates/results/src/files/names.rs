//! The names of the files that a run may write.

use std::path::{Path, PathBuf};

/// The file with everything that a run has found.
pub const REPORT: &str = "report.json";

/// The file with the SHA-256 of every other result. It is written last: without it a run has not ended.
pub const DIGESTS: &str = "SHA256SUMS";

/// The file with a row for each case of `[uncertainty]`.
pub const CASES: &str = "cases.csv";

/// All files that a run may write, except for their digests.
pub(super) const RESULTS: [&str; 14] = [
    REPORT,
    "report.html",
    "report.html.partial",
    "junit.xml",
    "recording.rrd",
    "recording.rrd.partial",
    "trajectory.csv",
    "trajectory.csv.partial",
    "trajectory.parquet",
    "trajectory.parquet.partial",
    "trajectory.mcap",
    "trajectory.mcap.partial",
    "scenario.resolved.toml",
    CASES,
];

/// Every file that a run may write to a folder.
pub fn result_files(folder: &Path) -> Vec<PathBuf> {
    result_names().map(|name| folder.join(name)).collect()
}

/// The digests first: the rest after a call that is killed while it removes them is not a finished run.
pub(super) fn result_names() -> impl Iterator<Item = &'static str> {
    [DIGESTS].into_iter().chain(RESULTS)
}
