//! The samples of a run, one after another, with the simulation on a thread of its own where that is possible.

use std::{panic::resume_unwind, sync::atomic::Ordering};

use congruent_monitors::{Recorder, RunningCheck};

use super::Run;
use crate::{
    outcome::RunError,
    source::{RunSource, SimulationSource},
};

impl Run<'_> {
    /// The loop. With the simulation computed ahead, on a thread of its own, unless a check may stop the run: then the next
    /// step depends on the checks of this one.
    pub(super) fn go_ahead(
        &mut self,
        checks: &mut [RunningCheck<'_>],
        recorder: &mut dyn Recorder,
        progress: impl FnMut(u64),
    ) -> Result<(), RunError> {
        let may_stop = checks.iter().any(RunningCheck::may_stop);
        let links = self.root_from_links.len();
        let ahead = if may_stop { None } else { self.source.compute_ahead(self.time_s, links) };
        let Some((mut simulation, thread)) = ahead else { return self.go(checks, recorder, progress) };
        let interrupt = self.interrupt;
        let (result, simulation) = std::thread::scope(|scope| {
            let computing = scope.spawn(move || {
                thread.compute(&mut simulation, interrupt);
                simulation
            });
            let result = EndsAhead(self).0.go(checks, recorder, progress);
            (result, computing.join().unwrap_or_else(|panic| resume_unwind(panic)))
        });
        self.source = RunSource::Simulation(simulation);
        if matches!(result, Err(RunError::Recording(_))) {
            // The thread was ahead by a number of steps that differs from call to call: results are those of the sample that
            // could not be recorded.
            self.source = RunSource::Simulation(Box::new(SimulationSource::at_step(self.setup, self.step)?));
        }
        result
    }

    fn go(
        &mut self,
        checks: &mut [RunningCheck<'_>],
        recorder: &mut dyn Recorder,
        mut progress: impl FnMut(u64),
    ) -> Result<(), RunError> {
        // The state at the start is a sample as well.
        self.compare()?;
        while !self.observe(checks, recorder)? {
            if !self.goes_on() {
                return Err(RunError::Interrupted);
            }
            if !self.step()? {
                break;
            }
            self.compare()?;
            progress(self.step);
        }
        Ok(())
    }

    /// Whether nobody has ended the run. What was computed ahead until then is still taken.
    fn goes_on(&mut self) -> bool {
        match &mut self.source {
            RunSource::Ahead(source) => source.has_next(),
            _ => !self.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)),
        }
    }
}

/// Ends the thread that computes ahead when the loop ends. Also by a panic: it would wait for the run for ever.
struct EndsAhead<'r, 'a>(&'r mut Run<'a>);

impl Drop for EndsAhead<'_, '_> {
    fn drop(&mut self) {
        if let RunSource::Ahead(source) = &mut self.0.source {
            source.end();
        }
    }
}
