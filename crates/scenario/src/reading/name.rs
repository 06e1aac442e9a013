//! The name of a scenario file, even if the file has errors.

use std::path::Path;

use congruent_input::{FileAccess, Override, toml_text::parse_document};

use super::{file::MOST_BYTES, robot_overrides::of_scenario};

/// The name of the scenario in a file that may have errors; `None` if the name cannot be read, or the file not a second time,
/// as from a pipe.
pub fn scenario_name(path: &Path, overrides: &[Override]) -> Option<String> {
    if !path.is_file() {
        return None;
    }
    let source = FileAccess::default().read_named_text(path, MOST_BYTES).ok()?;
    let mut document = parse_document(&source.text).ok()?;
    for change in of_scenario(overrides) {
        change.apply(&mut document).ok()?;
    }
    Some(document.get_ref().get("name")?.get_ref().as_str()?.to_owned())
}
