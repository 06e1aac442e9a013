//! The ends of what varies, before any case runs: a file that may not have such a value is a mistake of the scenario, no result.

use congruent_input::{Diagnostic, Findings};

use super::runner::CaseRunner;
use crate::plan::VariedKey;

/// Beginnings of the names of codes about a value that no file may have.
const OF_FILES: [&str; 3] = ["toml::", "cli::set", "scenario::type"];

impl CaseRunner<'_> {
    /// Refuses a distribution whose least or largest value, alone, makes a file that is refused, as a negative mass does. Start, motions and
    /// collisions are no matter of the file: they are what cases are about.
    ///
    /// # Errors
    /// A finding for each such key, at its place.
    pub fn check_ends(&self) -> Result<(), Findings> {
        let refused = |varied: &VariedKey| self.refused_end(varied);
        let found: Vec<Diagnostic> = self.plan().varied.iter().filter_map(refused).collect();
        if found.is_empty() { Ok(()) } else { Err(found.into()) }
    }

    fn refused_end(&self, varied: &VariedKey) -> Option<Diagnostic> {
        let is_of_file =
            |finding: &Diagnostic| OF_FILES.iter().any(|beginning| finding.code.name.starts_with(beginning));
        varied.distribution.ends().into_iter().find_map(|value| {
            let findings = self.setup_with(&self.plan().with_value(varied, &value)).err()?;
            let finding = findings.into_iter().find(is_of_file)?;
            let placed = self.plan().at_key(varied, finding);
            if placed.message.starts_with("key ") {
                return Some(placed);
            }
            let message = format!("key \"{}\" = {value}: {}", varied.keys.join(", "), placed.message);
            Some(Diagnostic { message, ..placed })
        })
    }
}
