//! `congruent sweep run`: runs cases of a plan and keeps their rows.

use std::{path::PathBuf, sync::atomic::Ordering};

use congruent::{
    input::Diagnostic,
    sweep::{
        codes,
        plan::SweepPlan,
        run::{CaseRow, CaseRunner, run_cases},
        store::{CaseRange, MergedTable, SweepFolder, SweepHeader, SweepProgress, missing},
    },
    text::sweep_progress_text,
};

use super::merge::{MergeArguments, merge};
use crate::{
    failure::{BROKEN, Failure},
    input::AccessArguments,
    interrupt::flag_of_signals,
    terminal::{print::Printer, progress::ProgressLines},
};

/// Runs the cases of a plan, each with a row in the folder; the whole plan is then merged into tables and a page.
///
/// A case that cannot be run is a row with the reason. A kill loses the cases in progress and nothing else: --resume runs what is missing.
/// Exit code 0 if the cases of a part have run, whatever their verdicts; of a whole plan, as of `sweep merge`.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The plan (*.sweep.toml): scenario, sampling, number of cases, and what varies.
    plan: PathBuf,
    /// The folder of rows, tables and pages; parts of one plan may share it.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Run these cases alone, A..B without B; the first is 0.
    #[arg(long, value_name = "A..B", conflicts_with = "shard")]
    cases: Option<String>,
    /// Run part I of N alone, from 1/N to N/N: for job arrays and CI matrices.
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,
    /// Run only what has no row yet.
    #[arg(long)]
    resume: bool,
    /// Number of cases that run at once; by default the number of cores. The rows do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    #[command(flatten)]
    merge: MergeArguments,
    #[command(flatten)]
    access: AccessArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let access = arguments.access.access()?;
    let plan = SweepPlan::read(&arguments.plan, &access)?;
    let runner = CaseRunner::new(&plan, access);
    let header = SweepHeader::new(&runner)?;
    if runner.first_setup()?.scenario.uncertainty.is_some() {
        printer.notes(["the cases of [uncertainty] do not run: a sweep has those of its plan"]);
    }
    let folder = SweepFolder::at(&arguments.out);
    folder.begin(&header)?;
    let range = arguments.range(&plan)?;
    let waiting = arguments.waiting(&folder, range)?;
    let ran = arguments.run_waiting(&runner, &folder, &waiting, printer)?;
    let table = MergedTable::read(&[folder])?;
    let is_interrupted = flag_of_signals().load(Ordering::Relaxed);
    let is_whole = range == CaseRange::all(plan.cases);
    if is_whole && !is_interrupted {
        return merge(&table, &arguments.out, &runner, arguments.merge, printer);
    }
    let progress = SweepProgress::new(&table, arguments.out.display().to_string(), ran);
    printer.result(&progress, sweep_progress_text)?;
    if is_interrupted {
        printer.notes(["interrupted: --resume runs what is missing"]);
    }
    Ok(if is_interrupted { BROKEN } else { 0 })
}

impl Arguments {
    fn range(&self, plan: &SweepPlan) -> Result<CaseRange, Diagnostic> {
        match (&self.cases, &self.shard) {
            (Some(cases), _) => CaseRange::parse(cases, plan.cases),
            (None, Some(shard)) => CaseRange::shard(shard, plan.cases),
            (None, None) => Ok(CaseRange::all(plan.cases)),
        }
    }

    /// The cases of the range that have no row.
    fn waiting(&self, folder: &SweepFolder, range: CaseRange) -> Result<Vec<CaseRange>, Diagnostic> {
        let known = MergedTable::read(std::slice::from_ref(folder))?;
        let waiting = missing(range, known.rows.iter().map(|row| row.case));
        let count: u64 = waiting.iter().map(|range| range.count()).sum();
        if count < range.count() && !self.resume {
            let (folder, there) = (folder.path().display(), range.count() - count);
            let message = format!("{folder} has rows of {there} of these {} cases", range.count());
            return Err(Diagnostic::error(codes::sweep::RANGE, message)
                .with_help("--resume runs the others; for all of them again choose another --out"));
        }
        Ok(waiting)
    }

    /// Runs the waiting cases; returns how many have run.
    fn run_waiting(
        &self,
        runner: &CaseRunner<'_>,
        folder: &SweepFolder,
        waiting: &[CaseRange],
        printer: &Printer,
    ) -> Result<u64, Failure> {
        let (Some(first), Some(last)) = (waiting.first(), waiting.last()) else {
            printer.notes(["no case of this part is missing"]);
            return Ok(0);
        };
        let mut writer = folder.writer(CaseRange { first: first.first, end: last.end })?;
        let count = waiting.iter().map(|range| range.count()).sum();
        let lines = ProgressLines::new(printer);
        let progress = lines.start_cases(&runner.plan().name, count);
        let cases = waiting.iter().flat_map(|range| range.first..range.end);
        let mut ran = 0;
        let take = |row: CaseRow| {
            writer.write(&row)?;
            ran += 1;
            progress.cases(ran);
            Ok::<(), Diagnostic>(())
        };
        let interrupt = flag_of_signals();
        let run = |case: u64| runner.run(case, &interrupt);
        let written = run_cases(cases, self.threads(count), &interrupt, run, take);
        written
            .map_err(|error| Failure::Machine(format!("{}; --resume goes on from here", error.message)))?;
        Ok(ran)
    }

    /// Number of threads for this number of cases.
    fn threads(&self, cases: u64) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.jobs.map_or_else(cores, usize::from).min(usize::try_from(cases).unwrap_or(usize::MAX))
    }
}
