//! The head of a scenario: its version, its name and its seed.

use congruent_input::Diagnostic;
use congruent_scenario::{FilePlace, SCHEMA_VERSION, Scenario};

use crate::codes;

/// The checks that the reader of a file does, for a scenario that was made in code.
pub(super) fn check_head(scenario: &Scenario, place: FilePlace<'_>) -> Result<(), Diagnostic> {
    let Scenario { schema_version, name, seed, .. } = scenario;
    let error = if *schema_version != SCHEMA_VERSION {
        Diagnostic::error(
            congruent_scenario::codes::scenario::VERSION,
            format!("schema_version = {schema_version} is not supported"),
        )
    } else if name.trim().is_empty() {
        Diagnostic::error(congruent_scenario::codes::scenario::NAME, "the name is empty")
    // The scenario is written out as TOML, whose integers are signed.
    } else if i64::try_from(*seed).is_err() {
        let message = format!("seed = {seed} is above {}, the largest integer of TOML", i64::MAX);
        place.key("seed").mark(Diagnostic::error(codes::scenario::SEED, message))
    } else {
        return Ok(());
    };
    Err(error)
}
