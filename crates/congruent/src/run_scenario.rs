//! A scenario from its setup to its results on disk, with the causes of what failed and the cases of `[uncertainty]`.

use std::{path::Path, sync::atomic::AtomicBool};

use congruent_input::{FileAccess, Findings, Override};
use congruent_results::{ExecuteError, Options, execute_with, files::OutputFolder, report::RunReport};
use congruent_sweep::{CaseThreads, UncertainCases, plan::SweepPlan, run::CaseRunner};
use congruent_twin::{Run, RunSetup};

use crate::replay::explain_recorded;

/// A scenario that is ready to run, with the cases of its `[uncertainty]`.
#[derive(Debug, Clone)]
pub struct PreparedScenario {
    /// The scenario as it is written, or the one case of `[uncertainty]` that it names.
    pub setup: RunSetup,
    /// Number of threads for the cases; by default the number of cores.
    pub case_threads: usize,
    cases: Option<PlannedCases>,
}

#[derive(Debug, Clone)]
struct PlannedCases {
    plan: SweepPlan,
    access: FileAccess,
}

/// How far a scenario is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunStage {
    /// So many steps of the scenario as it is written.
    Steps(u64),
    /// So many of its cases.
    Cases {
        /// Number of cases that have run.
        ran: u64,
        /// Number of all cases.
        of: u64,
    },
}

impl PreparedScenario {
    /// Reads a scenario file, with values in place of those of the file.
    ///
    /// # Errors
    /// Every finding, if one is an error; and those of [`PreparedScenario::new`].
    pub fn load(path: &Path, overrides: &[Override], access: &FileAccess) -> Result<Self, Findings> {
        let setup = RunSetup::load_with(path, overrides, access).and_then(RunSetup::for_simulation)?;
        Self::new(setup, access)
    }

    /// A scenario whose files are those of `access`.
    ///
    /// # Errors
    /// What is wrong with `[uncertainty]`: a key or a distribution; or its one case cannot be run.
    pub fn new(setup: RunSetup, access: &FileAccess) -> Result<Self, Findings> {
        let Some(plan) = SweepPlan::of_uncertainty(&setup, access)? else {
            return Ok(Self::without_cases(setup));
        };
        let case = setup.scenario.uncertainty.as_ref().and_then(|uncertainty| uncertainty.case);
        let runner = CaseRunner::new(&plan, access.clone()).with_controllers_of(&setup);
        runner.check_ends()?;
        runner.first_setup()?;
        if let Some(case) = case {
            let mut setup = runner.setup(&plan.case(case))?;
            // Beside the results of the scenario as it is written, not in their place.
            setup.scenario.name = format!("{}_case_{case}", setup.scenario.name);
            return Ok(Self::without_cases(setup));
        }
        let cases = Some(PlannedCases { access: access.clone(), plan });
        Ok(Self { cases, ..Self::without_cases(setup) })
    }

    /// A scenario without cases, whatever its `[uncertainty]` says.
    pub fn without_cases(setup: RunSetup) -> Self {
        let case_threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Self { setup, case_threads, cases: None }
    }
}

/// Runs a scenario, of a simulation or of a log, writes its results and returns the report. The cases of `[uncertainty]` run after the
/// scenario as it is written.
///
/// # Errors
/// [`ExecuteError`] if there can be no report. A run that fails midway has one.
pub fn run_scenario<'a>(
    scenario: &'a PreparedScenario,
    options: &Options<'a>,
    progress: &dyn Fn(RunStage),
) -> Result<(RunReport, OutputFolder), ExecuteError> {
    let PreparedScenario { setup, case_threads: jobs, cases } = scenario;
    let never = AtomicBool::new(false);
    let interrupt = options.interrupt.unwrap_or(&never);
    let explain = |run: &mut Run<'_>, outcome: &mut _| {
        let mut after = explain_recorded(run, outcome);
        if let Some(PlannedCases { plan, access }) = cases {
            let runner = CaseRunner::new(plan, access.clone()).with_controllers_of(setup);
            let (of, threads) = (plan.cases, CaseThreads { jobs: *jobs, interrupt });
            let progress = |ran| progress(RunStage::Cases { ran, of });
            let cases = UncertainCases::run(&runner, &outcome.checks, threads, progress);
            // Memory refuses no row.
            after.case_table = cases.csv(plan).ok();
            after.cases = Some(cases.report);
        }
        after
    };
    execute_with(setup, options, Run::new, explain, |steps| progress(RunStage::Steps(steps)))
}
