//! `congruent faults`: which check sees which fault, and what the diagnosis says.

use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use congruent::{
    description::Diagnostic,
    twin::{
        Run, RunSetup,
        recorder::NoRecorder,
        report::{FaultTable, RunReport},
    },
};

use crate::{
    failure::{BROKEN, FAILED, Failure, worse},
    input::AccessArguments,
    output::file::replace,
    terminal::{
        print::Printer,
        progress::{Progress, RunProgress},
    },
};

/// Runs scenarios that inject faults and shows which checks see them, after how long, and what the diagnosis says.
///
/// Exit codes: 1 if a fault is seen by no check or is not diagnosed, or if something is seen in a scenario without fault.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario files, with one [[fault]] or more, or with none for comparison.
    #[arg(required = true)]
    scenarios: Vec<PathBuf>,
    /// Also write the table into this file, between the lines `<!-- faults: begin -->` and `<!-- faults: end -->`.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    #[command(flatten)]
    access: AccessArguments,
}

const BEGIN: &str = "<!-- faults: begin -->\n";
const END: &str = "<!-- faults: end -->";

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let access = arguments.access.access()?;
    let load = |path: &PathBuf| -> Result<RunSetup, Failure> {
        let setup = RunSetup::load_with(path, &[], &access).and_then(RunSetup::for_simulation)?;
        printer.warnings(Some(path), &setup.description.warnings);
        printer.warnings(Some(path), &setup.warnings);
        Ok(setup)
    };
    let document = arguments.markdown.as_deref().map(Document::read).transpose()?;
    let progress = Progress::new(printer);
    let (mut reports, mut exit_code) = (Vec::new(), 0);
    for path in &arguments.scenarios {
        match load(path).and_then(|setup| report(&setup, &progress.of_run(&setup))) {
            Ok(report) => reports.push(report),
            // The others are answered all the same.
            Err(failure) if arguments.scenarios.len() > 1 => {
                Printer::explain(Some(path), &failure);
                exit_code = worse(exit_code, failure.exit_code());
            }
            Err(failure) => return Err(failure),
        }
    }
    let table = FaultTable::new(&reports);
    // A table of a part of the scenarios would look like one of all.
    if let Some(document) = document.filter(|_| exit_code == 0) {
        document.write(&table.markdown())?;
    }
    printer.result(&table, text)?;
    let of_table = match (table.broken.is_empty(), table.is_sound()) {
        (false, _) => BROKEN,
        (true, true) => 0,
        (true, false) => FAILED,
    };
    Ok(worse(exit_code, of_table))
}

fn report(setup: &RunSetup, progress: &RunProgress) -> Result<RunReport, Failure> {
    let refused = |error: &dyn std::fmt::Display| {
        let message = format!("scenario \"{}\" cannot run: {error}", setup.scenario.name);
        Diagnostic::error("run::cannot_run", message)
    };
    let run = Run::new(setup).map_err(|error| refused(&error))?;
    let sources = run.model().sources().to_vec();
    let (outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |steps| progress.steps(steps));
    Ok(RunReport::new(setup, &sources, outcome, result.as_ref().err()))
}

/// A document with a place for the table.
struct Document<'a> {
    path: &'a Path,
    before: String,
    after: String,
}

impl<'a> Document<'a> {
    fn read(path: &'a Path) -> Result<Self, Diagnostic> {
        let refused = |message: String| {
            Diagnostic::error("faults::markdown", message).with_help(format!(
                "the file needs a line `{}` and after it a line `{END}`",
                BEGIN.trim_end()
            ))
        };
        let text = fs::read_to_string(path)
            .map_err(|error| refused(format!("{} cannot be read: {error}", path.display())))?;
        let parts = text.split_once(BEGIN).and_then(|(before, rest)| {
            let (_, after) = rest.split_once(END)?;
            Some((before.to_owned(), after.to_owned()))
        });
        let (before, after) =
            parts.ok_or_else(|| refused(format!("{} has no place for the table", path.display())))?;
        Ok(Self { path, before, after })
    }

    fn write(&self, table: &str) -> Result<(), Failure> {
        let text = format!("{}{BEGIN}{table}{END}{}", self.before, self.after);
        // It is read and written.
        replace("--markdown", self.path, &text, &[])
    }
}

fn text(table: &FaultTable) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let _ = writeln!(text, "{} ({})", row.scenario, row.robot);
        let _ = writeln!(text, "  injected   {}", row.injected());
        let seen: Vec<String> = row
            .checks
            .iter()
            .filter(|seen| seen.fails && !seen.before_fault)
            .map(|seen| match seen.after_s {
                Some(_) => format!("{} after {}", seen.check, row.cell(seen.check)),
                None => seen.check.to_string(),
            })
            .collect();
        let seen = if seen.is_empty() { "no check".to_owned() } else { seen.join(", ") };
        let _ = writeln!(text, "  seen by    {seen}");
        let _ = writeln!(text, "  diagnosis  {} (right: {})", row.diagnosed(), row.judged());
    }
    for remark in table.remarks() {
        let _ = writeln!(text, "{remark}");
    }
    text
}
