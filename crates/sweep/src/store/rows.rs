//! Rows as they are in files: lines of JSON, of which the last may be cut off by a kill.

use std::{fs, path::Path};

use congruent_input::Diagnostic;

use crate::{codes, run::CaseRow};

/// The rows of a file. A last line without an end is of a call that was killed, and no row.
///
/// # Errors
/// Another line is none.
pub(super) fn read_rows(path: &Path) -> Result<Vec<CaseRow>, Diagnostic> {
    let text = fs::read(path).map_err(|error| congruent_input::unreadable(path, &error))?;
    let whole = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    let lines = text[..whole].split(|byte| *byte == b'\n').enumerate();
    lines
        .filter(|(_, line)| !line.is_empty())
        .map(|(at, line)| {
            serde_json::from_slice(line).map_err(|error| {
                let message = format!("{}, line {}: no row of a case: {error}", path.display(), at + 1);
                Diagnostic::error(codes::sweep::ROWS, message)
                    .with_help("remove the file, and run its cases again with --resume")
            })
        })
        .collect()
}
