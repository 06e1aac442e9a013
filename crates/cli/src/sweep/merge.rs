//! `congruent sweep merge`: the tables and the page of all rows.

#![expect(clippy::doc_markdown, reason = "the comments are printed as help, where backticks are noise")]

use std::path::{Path, PathBuf};

use congruent::{
    input::Diagnostic,
    results::{files::write_whole, report::RequirementVerdict},
    sweep::{
        codes,
        plan::SweepPlan,
        run::CaseRunner,
        store::{CASES_CSV, CASES_PARQUET, MergedTable, SweepFolder, SweepHeader, write_tables},
        summary::SweepSummary,
    },
    text::sweep_text,
};

use super::{page::write_page, worst::run_worst};
use crate::{
    failure::{FAILED, Failure, NOTHING, unwritable},
    input::AccessArguments,
    terminal::print::Printer,
};

/// Merges the rows of a sweep into cases.csv, cases.parquet, sweep_summary.json and index.html, and runs the worst cases again with
/// page and recording.
///
/// The digest that is printed is the same however the sweep was cut, and whichever machine ran which part. Exit code 1 if a case
/// failed, 4 if none failed but some could not be run or cases are missing. With [require] in the plan: 0 if it is met, 1 if not,
/// 4 if the cases are not enough to say.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The folder that `sweep run` was given as --out; several if parts have folders of their own. The tables go to the first.
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// The plan, if it is not where the first call of `sweep run` found it.
    #[arg(long)]
    plan: Option<PathBuf>,
    /// Merge although cases are missing.
    #[arg(long)]
    partial: bool,
    #[command(flatten)]
    merge: MergeArguments,
    #[command(flatten)]
    access: AccessArguments,
}

/// What a table is merged with.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(super) struct MergeArguments {
    /// Number of cases with the smallest margins that are listed, and run again with page and recording.
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub(super) worst: usize,
}

/// The summary for programs.
const SUMMARY: &str = "sweep_summary.json";

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let folders: Vec<SweepFolder> = arguments.folders.iter().map(|folder| SweepFolder::at(folder)).collect();
    let table = MergedTable::read(&folders)?;
    if !table.missing.is_empty() && !arguments.partial {
        let message = format!(
            "{} of {} cases have no row, the first of them {}",
            table.missing_count(),
            table.header.cases,
            table.missing[0].first
        );
        return Err(Diagnostic::error(codes::sweep::MISSING, message)
            .with_help(
                "run them with `congruent sweep run ... --resume`, or merge what there is with --partial",
            )
            .into());
    }
    let access = arguments.access.access()?;
    let path = arguments.plan.clone().unwrap_or_else(|| PathBuf::from(&table.header.plan));
    let plan = SweepPlan::read(&path, &access)?;
    let runner = CaseRunner::new(&plan, access);
    let header = SweepHeader::new(&runner)?;
    if header.identity != table.header.identity {
        let message = format!("{} is not the plan of these rows", path.display());
        return Err(Diagnostic::error(codes::sweep::OTHER_PLAN, message)
            .with_help(
                "give the plan that was run with --plan, with the scenario and robot files as they were",
            )
            .into());
    }
    merge(&table, &arguments.folders[0], &runner, arguments.merge, printer)
}

/// Writes the tables, runs the worst cases again and prints the summary.
pub(super) fn merge(
    table: &MergedTable,
    out: &Path,
    runner: &CaseRunner<'_>,
    arguments: MergeArguments,
    printer: &Printer,
) -> Result<u8, Failure> {
    table.examine(runner.plan())?;
    let mut summary = SweepSummary::new(table, runner.plan().require, arguments.worst);
    write_tables(table, out).map_err(|error| {
        let message = format!("{CASES_CSV} or {CASES_PARQUET} cannot be written: {error}");
        Diagnostic::error(codes::sweep::WRITE, message)
    })?;
    run_worst(&mut summary, table, out, runner, printer)?;
    let json = serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n";
    write_whole(&out.join(SUMMARY), json.as_bytes())
        .map_err(|error| unwritable(&error, "choose a folder that can be written"))?;
    write_page(&summary, table, out)?;
    let folder = out.display().to_string();
    printer.result(&summary, |summary| {
        let text = sweep_text(summary, &folder);
        if printer.is_quiet() { first_line(&text) } else { text }
    })?;
    Ok(exit_code(&summary))
}

/// The answer in one line.
fn first_line(text: &str) -> String {
    text.split_inclusive('\n').take(1).collect()
}

fn exit_code(summary: &SweepSummary) -> u8 {
    if let Some(requirement) = &summary.requirement {
        return match requirement.verdict {
            RequirementVerdict::Met => 0,
            RequirementVerdict::NotMet => FAILED,
            RequirementVerdict::NotEnoughCases => NOTHING,
        };
    }
    let count = |word: &str| summary.verdicts.get(word).copied().unwrap_or(0);
    if count("fail") + count("broken") > 0 {
        FAILED
    } else if count("pass") == summary.header.cases {
        0
    } else {
        NOTHING
    }
}
