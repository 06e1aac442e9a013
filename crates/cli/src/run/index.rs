//! The page over the scenarios of a call.

use std::{fs, path::Path};

use congruent::{
    page::{IndexEntry, index_page},
    results::files::write_whole,
};

use super::run_answer::RunAnswer;
use crate::{
    batch::Answer,
    failure::{Failure, unwritable},
    invocation,
};

/// The page over several scenarios.
const INDEX: &str = "index.html";

/// Removes the index of an earlier call. If it cannot be removed, it cannot be replaced either, and writing it
/// reports that.
pub(super) fn remove_index(out: &Path) {
    let _ = fs::remove_file(out.join(INDEX));
}

/// The page over all scenarios of a call, beside their folders, if there are several and one of them ran.
pub(super) fn write_index(answers: &[Answer<RunAnswer>], out: &Path) -> Result<(), Failure> {
    if answers.len() < 2 || answers.iter().all(|answer| answer.report().is_err()) {
        return Ok(());
    }
    let entries: Vec<IndexEntry<'_>> = answers.iter().map(entry).collect();
    let page = index_page(&entries, &invocation::command());
    write_whole(&out.join(INDEX), page.as_bytes())
        .map_err(|error| unwritable(&error, "choose a folder that can be written with --out"))
}

fn entry(answer: &Answer<RunAnswer>) -> IndexEntry<'_> {
    let page = |ran: &RunAnswer| {
        let folder = ran.results.as_ref().ok()?.file_name()?;
        Some(format!("{}/report.html", folder.to_string_lossy()))
    };
    IndexEntry {
        input: answer.input(),
        page: answer.report().ok().and_then(page),
        result: answer.report().map(|ran| &ran.report),
    }
}
