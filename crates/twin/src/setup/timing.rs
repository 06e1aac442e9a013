//! When the samples of a run are: by the log, or by the clock of the simulation; and what depends on that.

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Diagnostics};
use congruent_monitors::{RunClock, taken_too_late};
use congruent_scenario::Scenario;

use super::{output, recorded::RecordedSetup, written_at::WrittenAt};

/// The clock of a run, and the log that it is of.
pub(super) struct RunTiming {
    /// `None` if it, or the log, was refused.
    pub(super) clock: Option<RunClock>,
    /// `None` for a simulation.
    pub(super) recorded: Option<RecordedSetup>,
    pub(super) warnings: Vec<Diagnostic>,
}

impl RunTiming {
    /// Checks clock, log and output of a scenario whose motions take `motions_s`; errors go into `found`.
    pub(super) fn new(
        scenario: &Scenario,
        written: WrittenAt<'_>,
        description: &RobotDescription,
        motions_s: f64,
        found: &mut Diagnostics,
    ) -> Self {
        let (place, mut warnings) = (written.place, Vec::new());
        let recorded = RecordedSetup::new(scenario, written, description, found, &mut warnings);
        let clock = if scenario.source.is_some() {
            recorded.as_ref().map(|recorded| recorded.clock.clone())
        } else {
            let place = place.key("simulation");
            found.keep(RunClock::new(&scenario.simulation, place, motions_s, &mut warnings))
        };
        warnings.extend(clock.iter().flat_map(|clock| taken_too_late(scenario, place, clock.duration_s())));
        found.keep(output::check(scenario, place.key("output"), clock.as_ref()));
        Self { clock, recorded, warnings }
    }
}
