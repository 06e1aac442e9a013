//! The cases of `[uncertainty]` of a scenario, after the run of the scenario as it is written.

use std::{convert::Infallible, sync::atomic::AtomicBool};

use congruent_monitors::verdict::CheckResult;
use congruent_results::report::{CaseChecks, CheckInCases, QuantityInCases, UncertaintyReport};
use congruent_tables::writer::TableWriteError;

use crate::{
    plan::SweepPlan,
    run::{CaseRow, CaseRunner, OF_CHANGING_PAIRS, check_names, measure_name, run_cases},
    store::csv_of_rows,
    summary::importances,
};

/// How cases run.
#[derive(Debug, Clone, Copy)]
pub struct CaseThreads<'a> {
    /// Number of threads.
    pub jobs: usize,
    /// Ends the cases in order once it is set: those that have not ended are missing in the report.
    pub interrupt: &'a AtomicBool,
}

/// The cases of a scenario that have run.
#[derive(Debug, Clone, PartialEq)]
pub struct UncertainCases {
    /// What they show of each check.
    pub report: UncertaintyReport,
    /// A row for each, in their order.
    pub rows: Vec<CaseRow>,
}

impl UncertainCases {
    /// Runs every case of the plan of a scenario with `[uncertainty]`, whose own run had these checks. `progress` is called with the
    /// number of cases that have run.
    ///
    /// # Panics
    /// If the scenario of the plan has no `[uncertainty]`, or the controllers of the cases do not know those of the scenario
    /// ([`CaseRunner::with_controllers_of`]).
    pub fn run(
        runner: &CaseRunner<'_>,
        own: &[CheckResult],
        threads: CaseThreads<'_>,
        mut progress: impl FnMut(u64),
    ) -> Self {
        let known = runner.known().expect("controllers know the scenario as it is written");
        let (plan, CaseThreads { jobs, interrupt }) = (runner.plan(), threads);
        let mut cases: Vec<(CaseRow, CaseChecks)> = Vec::new();
        let taken = run_cases(
            0..plan.cases,
            jobs,
            interrupt,
            |case| run_case(runner, case, interrupt),
            |case| {
                cases.push(case);
                progress(cases.len() as u64);
                Ok::<(), Infallible>(())
            },
        );
        let Ok(()) = taken;
        cases.sort_by_key(|(row, _)| row.case);
        let (rows, checks): (Vec<CaseRow>, Vec<CaseChecks>) = cases.into_iter().unzip();
        let mut report = UncertaintyReport::new(&known.scenario, plan.varied_values(), own, checks);
        let names = check_names(own);
        for check in &mut report.checks {
            decide(check, &names[check.number - 1], plan, &rows);
        }
        Self { report, rows }
    }

    /// The rows as the text of a CSV file.
    ///
    /// # Errors
    /// None that memory has.
    pub fn csv(&self, plan: &SweepPlan) -> Result<Vec<u8>, TableWriteError> {
        csv_of_rows(&plan.keys(), &self.rows)
    }
}

/// The row and the checks of a case; `None` if it was interrupted.
fn run_case(runner: &CaseRunner<'_>, number: u64, interrupt: &AtomicBool) -> Option<(CaseRow, CaseChecks)> {
    let case = runner.plan().case(number);
    Some(match runner.report(&case, interrupt)? {
        Ok(report) => {
            let checks = CaseChecks::new(number, &report.checks, report.error.as_deref());
            (CaseRow::of_run(case, &report), checks)
        }
        Err(error) => {
            (CaseRow::refused(case, error.clone()), CaseChecks { case: number, checks: Err(error) })
        }
    })
}

/// Adds to the quantities of a check the varied keys that decide them.
fn decide(check: &mut CheckInCases, name: &str, plan: &SweepPlan, rows: &[CaseRow]) {
    let keys = plan.keys();
    for of in &mut check.quantities {
        let QuantityInCases { quantity, unit, of_changing_pairs, .. } = *of;
        let end = if of_changing_pairs { OF_CHANGING_PAIRS } else { "" };
        let name = measure_name(name, quantity, unit) + end;
        let with_value: Vec<&CaseRow> = rows.iter().filter(|row| row.worst.contains_key(&name)).collect();
        let values: Vec<f64> =
            with_value.iter().map(|row| row.worst[&name].value.unwrap_or(f64::NAN)).collect();
        let mut deciding = importances(&keys, plan.sampling, &with_value, &values);
        // What may be chance decides nothing.
        deciding.retain(|key| key.interval[0] > 0.0);
        of.deciding = deciding;
    }
}
