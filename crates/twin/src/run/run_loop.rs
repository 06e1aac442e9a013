//! The samples of a run, one after another, with the simulation on a thread of its own where that is possible.

use std::{panic::resume_unwind, sync::atomic::Ordering};

use congruent_monitors::{Recorder, RunningCheck, verdict::CheckResult};
use sha2::Digest;

use super::Run;
use crate::{
    outcome::{Outcome, RunError, braked, hex},
    source::{RunSource, SimulatedRobot, SimulationSource},
};

impl Run<'_> {
    /// Runs to the end, or to rest after the first violation of a check that stops the run. After an error, the
    /// outcome holds the results up to it.
    pub fn finish(
        &mut self,
        checks: &mut [RunningCheck<'_>],
        recorder: &mut dyn Recorder,
        progress: impl FnMut(u64),
    ) -> (Outcome, Result<(), RunError>) {
        // An error ends the loop, but the results so far still get into the outcome.
        let result = self.go_ahead(checks, recorder, progress);
        let steps = self.setup.clock.steps_with(self.longer_s());
        // The error of the run itself is the cause; one of the clean-up follows from it.
        let servos = self.source.simulated_mut().map(SimulatedRobot::finish).transpose();
        let (servos, result) = match servos.map(Option::unwrap_or_default) {
            Ok(servos) => (servos, result),
            Err(error) => (Vec::new(), result.and(Err(error.into()))),
        };
        let mut results: Vec<CheckResult> = checks.iter().map(|check| check.result(&self.names)).collect();
        let stopped = self.stopping.as_ref().map(|stopping| {
            let result = &mut results[stopping.check()];
            let declared = self.setup.trajectory.declared_accelerations();
            let robot = &self.setup.description.robot;
            let simulated = self.source.simulated();
            let lost = simulated.map_or(&[][..], SimulatedRobot::stopped_at_end_of_range);
            let braked = braked(robot, declared, lost);
            result.notes.push(stopping.note(steps, robot, &braked));
            stopping.report(result, &self.names.joints, braked)
        });
        let simulated = self.source.simulated();
        let outcome = Outcome {
            stopped,
            checks: results,
            steps: self.step,
            duration_s: self.time_s - self.start_s,
            servos,
            actuators: simulated.map(SimulatedRobot::actuators).unwrap_or_default(),
            slowed: simulated.map(SimulatedRobot::slowed).unwrap_or_default().to_vec(),
            trajectory_sha256: hex(&self.hash.finalize_reset()),
        };
        (outcome, result)
    }

    /// The loop. With the simulation computed ahead, on a thread of its own, unless a check may stop the run: then the next
    /// step depends on the checks of this one.
    pub(super) fn go_ahead(
        &mut self,
        checks: &mut [RunningCheck<'_>],
        recorder: &mut dyn Recorder,
        progress: impl FnMut(u64),
    ) -> Result<(), RunError> {
        let may_not = !self.may_compute_ahead || checks.iter().any(RunningCheck::may_stop);
        let links = self.root_from_links.len();
        let ahead = if may_not { None } else { self.source.compute_ahead(self.time_s, links) };
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
                self.end(checks);
                break;
            }
            self.compare()?;
            progress(self.step);
        }
        Ok(())
    }

    /// The source has ended, and did not know it at the sample before: what the end shows is judged at that one.
    fn end(&mut self, checks: &mut [RunningCheck<'_>]) {
        let mut sample = self.sample();
        sample.is_last = true;
        for check in checks {
            check.monitor.end(&sample);
        }
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
