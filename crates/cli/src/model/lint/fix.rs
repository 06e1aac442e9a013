//! `lint --fix`: writes the safe corrections, each file whole or not at all.

use std::{fs, sync::Arc};

use congruent::{
    LintFix,
    input::{SourceFile, TextEdit, changed_lines, edited, is_standard_input},
    results::files::write_whole,
};

use super::diff::unified;
use crate::failure::{Failure, unwritable};

/// The byte order mark.
const MARK: &str = "\u{feff}";

/// The files that are corrected, each with all of its changes.
fn files(fixes: &[LintFix]) -> Vec<(&Arc<SourceFile>, Vec<TextEdit>)> {
    let mut files: Vec<(&Arc<SourceFile>, Vec<TextEdit>)> = Vec::new();
    for fix in fixes.iter().filter(|fix| !is_standard_input(&fix.source.path)) {
        match files.iter_mut().find(|(source, _)| source.path == fix.source.path) {
            Some((_, edits)) => edits.extend(fix.edits.iter().cloned()),
            None => files.push((&fix.source, fix.edits.clone())),
        }
    }
    files
}

/// What changes, as a unified diff.
pub(super) fn difference(fixes: &[LintFix]) -> String {
    let of = |(source, edits): &(&Arc<SourceFile>, Vec<TextEdit>)| {
        let changed = changed_lines(&source.text, edits);
        unified(&source.path.display().to_string(), &source.text, &changed)
    };
    files(fixes).iter().map(of).collect()
}

/// Writes the corrected files; whether there are any.
pub(super) fn write(fixes: &[LintFix]) -> Result<bool, Failure> {
    let files = files(fixes);
    for (source, edits) in &files {
        // The mark is not part of the text that was read and corrected; it is written back.
        let mark = fs::read(&source.path).is_ok_and(|old| old.starts_with(MARK.as_bytes()));
        let text = [if mark { MARK } else { "" }, &edited(&source.text, edits)].concat();
        write_whole(&source.path, text.as_bytes())
            .map_err(|error| unwritable(&error, "--dry-run only shows the difference"))?;
    }
    Ok(!files.is_empty())
}
