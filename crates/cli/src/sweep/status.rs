//! `congruent sweep status`: how far a sweep is.

use std::path::PathBuf;

use congruent::{
    sweep::{
        plan::SweepPlan,
        run::CaseRunner,
        store::{MergedTable, SweepFolder, SweepHeader, SweepProgress},
    },
    text::sweep_progress_text,
};

use crate::{
    failure::{Failure, NOTHING},
    input::AccessArguments,
    terminal::print::Printer,
};

/// How far a sweep is: rows by verdict, and the cases that have none. Exit code 4 if cases are missing.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The folder that `sweep run` was given as --out; several if parts have folders of their own.
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Begin the first folder for this plan if it has no sweep yet; refused if it has another one.
    #[arg(long)]
    plan: Option<PathBuf>,
    #[command(flatten)]
    access: AccessArguments,
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let folders: Vec<SweepFolder> = arguments.folders.iter().map(|folder| SweepFolder::at(folder)).collect();
    if let Some(plan) = &arguments.plan {
        let access = arguments.access.access()?;
        let plan = SweepPlan::read(plan, &access)?;
        let header = SweepHeader::new(&CaseRunner::new(&plan, access))?;
        folders[0].begin(&header)?;
    }
    let table = MergedTable::read(&folders)?;
    let names: Vec<String> = arguments.folders.iter().map(|folder| folder.display().to_string()).collect();
    let progress = SweepProgress::new(&table, names.join(" "), 0);
    printer.result(&progress, sweep_progress_text)?;
    Ok(if table.missing.is_empty() { 0 } else { NOTHING })
}
