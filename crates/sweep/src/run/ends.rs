//! The ends of what varies, before any case runs: a value that no scenario may have is a mistake, no result.

use congruent_input::{Diagnostic, Findings, Severity};
use congruent_twin::is_of_the_run;

use super::runner::CaseRunner;
use crate::plan::{Distribution, VariedKey};

impl CaseRunner<'_> {
    /// Refuses a distribution whose least or largest value, alone, makes a scenario that is refused, as a negative mass does. A start or a
    /// motion that the robot cannot take is no such mistake.
    ///
    /// # Errors
    /// A finding for each such key, at its place.
    pub fn check_ends(&self) -> Result<(), Findings> {
        let refused = |varied: &VariedKey| self.refused_end(varied);
        let found: Vec<Diagnostic> = self.plan().varied.iter().filter_map(refused).collect();
        if found.is_empty() { Ok(()) } else { Err(found.into()) }
    }

    fn refused_end(&self, varied: &VariedKey) -> Option<Diagnostic> {
        let (key, distribution) = (varied.keys.join(", "), &varied.distribution);
        distribution.ends().into_iter().find_map(|[end, inside]| {
            let finding = self.mistake(varied, &end)?;
            // An end alone, which no case draws, may be out of a range that is open there: a mass from 0 on.
            self.mistake(varied, &inside)?;
            let placed = self.plan().at_key(varied, finding);
            if placed.message.starts_with("key ") {
                return Some(placed);
            }
            let message = format!("key \"{key}\" = {end}: {}", placed.message);
            let cut = match distribution {
                Distribution::Normal { range, .. } if range.iter().any(|end| end.is_infinite()) => {
                    Some("cut the normal distribution by min and max".to_owned())
                }
                _ => None,
            };
            Some(Diagnostic { message, help: cut.or(placed.help.clone()), ..placed })
        })
    }

    /// What is wrong with the scenario if a key has a value.
    fn mistake(&self, varied: &VariedKey, value: &str) -> Option<Diagnostic> {
        let findings = self.setup_with(&self.plan().with_value(varied, value)).err()?;
        findings.into_iter().find(|finding| finding.severity == Severity::Error && !is_of_the_run(finding))
    }
}
