//! The cases of `[uncertainty]` of a scenario as a plan.

use std::sync::Arc;

use congruent_input::{Diagnostic, Diagnostics, FileAccess, Findings, Override, is_standard_input};
use congruent_results::report::VariedValue;
use congruent_scenario::ScenarioFile;
use congruent_twin::RunSetup;

use super::{
    nominal::NominalValues,
    read::{SEED, SweepPlan, at, checked_cases, repeated},
    varied::{VariedKey, varied},
};
use crate::{codes, sampling::PointSource};

impl SweepPlan {
    /// The cases of `[uncertainty]`; `None` if the scenario has none.
    ///
    /// # Errors
    /// What is wrong with a distribution or a key, or the scenario is not in a file that can be read again.
    pub fn of_uncertainty(setup: &RunSetup, access: &FileAccess) -> Result<Option<Self>, Findings> {
        let Some(uncertainty) = &setup.scenario.uncertainty else { return Ok(None) };
        let Some(path) = setup.path.as_deref().filter(|path| !is_standard_input(path)) else {
            let error = Diagnostic::error(
                codes::sweep::NO_FILE,
                "the cases of [uncertainty] need the scenario as a file",
            );
            return Err(error.with_help("write it into a file, and run that").into());
        };
        let set: Vec<Override> = setup.overrides.iter().filter_map(|change| change.parse().ok()).collect();
        let file = ScenarioFile::read_with(path, &set, access)?;
        let nominal = NominalValues { scenario: path, overrides: &set, access };
        let mut found = Diagnostics::default();
        let entries = uncertainty.vary.iter().enumerate().filter_map(|(index, vary)| {
            let place = file.place().key("uncertainty").key("vary").item(index).span().unwrap_or_default();
            let varied = varied(vary, &place, uncertainty.sampling, nominal);
            found.keep(varied.map_err(|fault| at(fault, place.clone())))
        });
        let varied: Vec<VariedKey> = entries.flatten().collect();
        found.extend(repeated(std::iter::empty(), &varied));
        let (seed, sampling) = (setup.scenario.seed, uncertainty.sampling);
        // After errors the keys are not all there, of which the number of cases may follow.
        let cases = if found.has_error() {
            None
        } else {
            Some(checked_cases(sampling, Some(uncertainty.cases), &varied))
        };
        let place = file.place().key("uncertainty").key("cases");
        let cases = cases.and_then(|cases| found.keep(cases.map_err(|fault| place.mark(fault))));
        let Some(cases) = cases else { return Err(found.in_file(file.source()).into()) };
        let steps = varied.iter().map(|varied| varied.steps).collect();
        let is_seed = |change: &Override| change.path().eq([SEED]);
        Ok(Some(Self {
            name: setup.scenario.name.clone(),
            path: path.to_owned(),
            scenario: path.to_owned(),
            sampling,
            cases,
            seed,
            varied,
            // Each case has a seed of its own, which follows from that of the scenario.
            set: set.iter().filter(|change| !is_seed(change)).cloned().collect(),
            require: None,
            varies_what_is_set: true,
            points: PointSource::new(sampling, seed, cases, steps),
            source: Arc::clone(file.source()),
        }))
    }

    /// What varies, for a report: each `[[vary]]` once, however many numbers it varies.
    pub fn varied_values(&self) -> Vec<VariedValue> {
        let mut values: Vec<&VariedKey> = self.varied.iter().collect();
        values.dedup_by_key(|varied| varied.place.clone());
        values.into_iter().map(|varied| varied.described.clone()).collect()
    }
}
