//! `congruent run --faults`: which check sees which fault, and what the diagnosis says.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::{
    input::Diagnostic,
    monitors::NoRecorder,
    results::report::{AfterRun, FaultTable, RunReport, diagnose_run},
    text::fault_table_text,
    twin::{Run, RunSetup},
};

use super::arguments::Arguments;
use crate::{
    codes,
    failure::{BROKEN, FAILED, Failure, worse},
    output::file::replace,
    terminal::{
        print::Printer,
        progress::{ProgressLines, RunProgress},
    },
};

const BEGIN: &str = "<!-- faults: begin -->\n";
const END: &str = "<!-- faults: end -->";

pub(super) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let overrides = arguments.overrides();
    let access = arguments.access.access()?;
    let load = |path: &PathBuf| -> Result<RunSetup, Failure> {
        let setup = RunSetup::load_with(path, &overrides, &access).and_then(RunSetup::for_simulation)?;
        printer.warnings(Some(path), &setup.description.warnings);
        printer.warnings(Some(path), &setup.warnings);
        if setup.scenario.uncertainty.is_some() {
            printer.notes(["the cases of [uncertainty] do not run: faults are injected into the scenario as it is written"]);
        }
        Ok(setup)
    };
    let document = arguments.faults.markdown.as_deref().map(MarkdownDocument::read).transpose()?;
    let progress = ProgressLines::new(printer);
    let (mut reports, mut exit_code) = (Vec::new(), 0);
    for path in &arguments.scenarios {
        match load(path).and_then(|setup| report(&setup, &progress.start_run(&setup))) {
            Ok(report) => reports.push(report),
            // The other scenarios are still answered.
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
    printer.result(&table, fault_table_text)?;
    let table_code = match (table.broken.is_empty(), table.is_sound()) {
        (false, _) => BROKEN,
        (true, true) => 0,
        (true, false) => FAILED,
    };
    Ok(worse(exit_code, table_code))
}

fn report(setup: &RunSetup, progress: &RunProgress) -> Result<RunReport, Failure> {
    let refused = |error: &dyn std::fmt::Display| {
        let message = format!("scenario \"{}\" cannot run: {error}", setup.scenario.name);
        Diagnostic::error(congruent::codes::run::CANNOT_RUN, message)
    };
    let mut run = Run::new(setup).map_err(|error| refused(&error))?;
    let sources = run.model().sources().to_vec();
    let (outcome, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |steps| progress.steps(steps));
    let causes = AfterRun::from_samples(diagnose_run(&mut run, &outcome));
    Ok(RunReport::new(setup, &sources, outcome, causes, result.as_ref().err()))
}

/// A document with a place for the table.
struct MarkdownDocument<'a> {
    path: &'a Path,
    before: String,
    after: String,
}

impl<'a> MarkdownDocument<'a> {
    fn read(path: &'a Path) -> Result<Self, Diagnostic> {
        let refused = |message: String| {
            Diagnostic::error(codes::faults::MARKDOWN, message).with_help(format!(
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
