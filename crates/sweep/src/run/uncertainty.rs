//! The cases of `[uncertainty]` of a scenario, after the run of the scenario as it is written.

use std::{convert::Infallible, sync::atomic::AtomicBool};

use congruent_monitors::verdict::CheckResult;
use congruent_results::report::{CaseChecks, UncertaintyReport};

use super::{runner::CaseRunner, threads::run_cases};

/// How cases run.
#[derive(Debug, Clone, Copy)]
pub struct CaseThreads<'a> {
    /// Number of threads.
    pub jobs: usize,
    /// Ends the cases in order once it is set: those that have not ended are missing in the report.
    pub interrupt: &'a AtomicBool,
}

impl CaseRunner<'_> {
    /// Runs every case of the plan of a scenario with `[uncertainty]`, whose own run had these checks. `progress` is called with the
    /// number of cases that have run.
    ///
    /// # Panics
    /// If the scenario of the plan has no `[uncertainty]`, or the controllers of the cases do not know those of the scenario
    /// ([`CaseRunner::with_controllers_of`]).
    pub fn run_uncertainty(
        &self,
        own: &[CheckResult],
        threads: CaseThreads<'_>,
        mut progress: impl FnMut(u64),
    ) -> UncertaintyReport {
        let known = self.known().expect("controllers know the scenario as it is written");
        let CaseThreads { jobs, interrupt } = threads;
        let run = |case: u64| {
            Some(match self.report(&self.plan().case(case), interrupt)? {
                Ok(report) => CaseChecks::new(case, &report.checks, report.error.as_deref()),
                Err(error) => CaseChecks { case, checks: Err(error) },
            })
        };
        let mut cases = Vec::new();
        let taken = run_cases(0..self.plan().cases, jobs, interrupt, run, |case: CaseChecks| {
            cases.push(case);
            progress(cases.len() as u64);
            Ok::<(), Infallible>(())
        });
        let Ok(()) = taken;
        UncertaintyReport::new(&known.scenario, self.plan().varied_values(), own, cases)
    }
}
