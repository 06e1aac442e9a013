//! The numbers that a scenario file has under a key.

use std::path::Path;

use congruent_input::{Diagnostic, FileAccess, NumberAt, Override, toml_text::parse_document};

use super::{file::MOST_BYTES, robot_overrides::of_scenario};

/// The numbers of a scenario file under a key, each with a key of its own, after `overrides`. Empty if the file has no such key.
///
/// # Errors
/// The file cannot be read, or the key has something else than numbers.
pub fn written_numbers(
    path: &Path,
    overrides: &[Override],
    key: &Override,
    access: &FileAccess,
) -> Result<Vec<NumberAt>, Diagnostic> {
    let source = access.read_named_text(path, MOST_BYTES)?;
    let mut document = parse_document(&source.text).map_err(|fault| fault.in_file(&source))?;
    for change in of_scenario(overrides) {
        change.apply(&mut document)?;
    }
    key.numbers_in(&document)
}
