//! The page of a sweep.

use std::path::Path;

use congruent::{
    page::sweep_page,
    results::files::write_whole,
    sweep::{store::MergedTable, summary::SweepSummary},
};

use crate::{
    failure::{Failure, unwritable},
    invocation,
};

/// The page over all cases.
const INDEX: &str = "index.html";

pub(super) fn write_page(summary: &SweepSummary, table: &MergedTable, out: &Path) -> Result<(), Failure> {
    let page = sweep_page(summary, table, &invocation::command());
    write_whole(&out.join(INDEX), page.as_bytes())
        .map_err(|error| unwritable(&error, "choose a folder that can be written with --out"))
}
