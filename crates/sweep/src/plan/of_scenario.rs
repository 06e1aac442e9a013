//! The cases of `[uncertainty]` of a scenario as a plan.

use std::sync::Arc;

use congruent_input::{Diagnostic, Diagnostics, FileAccess, Findings, Override, is_standard_input};
use congruent_results::report::VariedValue;
use congruent_scenario::ScenarioFile;
use congruent_twin::RunSetup;

use super::{
    key::refuse_fixed,
    nominal::NominalValues,
    read::{SEED, SweepPlan, at, checked_cases, repeated},
    varied::{VariedKey, varied},
};
use crate::{codes, sampling::PointSource};

/// Keys that cannot vary within one scenario, and why.
const FIXED: [(&str, &str); 6] = [
    ("seed", "each case has a seed of its own"),
    ("expect", "it says what passes"),
    ("check", "it says what passes"),
    ("output", "cases write no files"),
    ("folder", "it says where the files are"),
    ("source", "a log has no cases"),
];
/// The key of the robot, which cannot vary by itself; the values inside of it can.
const ROBOT: &str = "robot";
/// Keys of distributions.
const DISTRIBUTIONS: [&str; 7] =
    ["plus_minus", "percent", "uniform", "log_uniform", "normal", "triangular", "values"];

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
            let entry = file.place().key("uncertainty").key("vary").item(index);
            let key = entry.key("key").span().or_else(|| entry.span()).unwrap_or_default();
            let may_vary = vary.key.as_slice().iter().try_for_each(|key| refuse_fixed_here(key));
            let varied = may_vary.and_then(|()| varied(vary, &key, uncertainty.sampling, nominal));
            found.keep(varied.map_err(|fault| {
                let of_distribution = DISTRIBUTIONS.iter().find_map(|name| entry.key(name).span());
                let place = of_distribution.filter(|_| fault.code == codes::sweep::DISTRIBUTION);
                at(fault, place.unwrap_or_else(|| key.clone()))
            }))
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

/// Refuses a key that cannot vary within one scenario.
fn refuse_fixed_here(key: &str) -> Result<(), Diagnostic> {
    if key == ROBOT {
        let message = "the robot cannot vary: controllers know the one of the file";
        return Err(Diagnostic::error(codes::sweep::KEY, message)
            .with_help("vary its values, as robot.link.NAME.mass_kg, or run a sweep over several robots"));
    }
    refuse_fixed(key, &FIXED)
}
