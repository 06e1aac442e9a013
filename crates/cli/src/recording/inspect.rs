//! `congruent inspect`: what a recording holds, its verdict, and whether its series show what its report says.

use std::path::{Path, PathBuf};

use congruent::{
    input::{Diagnostic, FileAccess, absence},
    monitors::verdict::Verdict,
    recording::{Recheck, RecordingSummary, RerunFormat, inspect, recheck, scalars, scalars_csv},
    results::{RecordingFormat, files::result_files, report::TestSuite},
    text::{disagreement_sentence, recording_text},
    twin::RunSetup,
};

use super::{
    inspected_files::{compare_files, judge_inputs, overrides, runs_in, without_recording},
    inspected_suite::suite,
};
use crate::{
    batch::{Batch, BatchReport},
    ci::CiArguments,
    codes,
    failure::{BAD_INPUT, BROKEN, Failure, worse},
    input::AccessArguments,
    output::file::{refuse_inputs, refuse_same, replace},
    terminal::print::{Printer, text_options},
};

/// Summarises recordings: verdict, worst values, duration, and problems of the file; with -v also entities, scalars and properties.
///
/// The exit code is that of the recorded run: 1 if its verdict was not as expected, 3 if it broke, 4 if it checked
/// nothing. It is 2 if a file is not a recording, is cut off or damaged, holds a second recording, has no footer, NaN
/// values or times out of order, or if results beside it (report.json and what SHA256SUMS names) are not those of
/// its run; and 4 without a verdict, or if inputs of the run (scenario, robot files, meshes) have changed since. With
/// --check it is that of the new check, 1 if series and report disagree, and 2 if the scenario has other checks or
/// another robot; changed inputs are only reported. For several recordings it is the worst.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Recordings (.rrd), folders of results, or the folder of --out with the results of several runs.
    #[arg(required = true)]
    recordings: Vec<PathBuf>,
    /// Evaluate the checks of this scenario again, on the recordings alone, and compare with the report in each.
    ///
    /// Values that --set replaced in the run are replaced here, too. With a scenario that has different limits, the
    /// answer is whether the run would have passed with these limits.
    #[arg(long, value_name = "SCENARIO")]
    check: Option<PathBuf>,
    /// Also write all scalar series of one recording as a table: time, then a column for each series.
    ///
    /// A row for each instant at which any series has a value; a series without a value there has an empty cell.
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    ci: CiArguments,
    #[command(flatten)]
    access: AccessArguments,
}

impl BatchReport for RecordingSummary {
    fn exit_code(&self) -> u8 {
        self.exit_code
    }

    fn text(&self) -> String {
        recording_text(self, &text_options())
    }

    fn one_line(&self) -> Option<String> {
        self.text().lines().next().map(str::to_owned)
    }

    fn test_suite(&self, input: &str) -> TestSuite {
        suite(self, input)
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let recordings: Vec<PathBuf> = arguments.recordings.iter().flat_map(|path| runs_in(path)).collect();
    examine(arguments, &recordings)?;
    let batch = Batch::begin(&recordings, &arguments.ci, printer)?;
    let answers = recordings.iter().map(|path| batch.answer(path, || answer(path, arguments, &batch)));
    batch.finish(answers.collect())
}

/// The table is of one recording; no output is another one, or a file that is read.
fn examine(arguments: &Arguments, recordings: &[PathBuf]) -> Result<(), Diagnostic> {
    let csv = arguments.csv.as_deref().map(|file| ("--csv", file));
    refuse_same(arguments.ci.outputs().chain(csv))?;
    let inputs: Vec<PathBuf> = recordings.iter().chain(&arguments.check).cloned().collect();
    let beside = |path: &PathBuf| if path.is_dir() { path.clone() } else { path.with_file_name("") };
    let results = recordings.iter().flat_map(|path| result_files(&beside(path)));
    let inputs: Vec<PathBuf> = inputs.into_iter().chain(results).collect();
    arguments.ci.is_none_of(&inputs)?;
    let Some(file) = &arguments.csv else { return Ok(()) };
    let refused =
        |message: String, help: &str| Err(Diagnostic::error(codes::inspect::CSV, message).with_help(help));
    if recordings.len() > 1 {
        let message = format!("--csv {} is a table of one recording", file.display());
        return refused(message, "give one recording");
    }
    refuse_inputs("--csv", file, &inputs)
}

fn answer(path: &Path, arguments: &Arguments, batch: &Batch<'_>) -> Result<RecordingSummary, Failure> {
    let unreadable = |error: congruent::recording::InspectError| {
        Diagnostic::error(codes::inspect::RECORDING, error.to_string())
    };
    let in_folder = path.join(RerunFormat.file_name());
    if let Some(missing) = without_recording(path) {
        return Err(missing.into());
    }
    refuse_other(path, &in_folder)?;
    let path = if path.is_dir() { in_folder.as_path() } else { path };
    let access = arguments.access.access()?;
    if arguments.check.is_none() && arguments.csv.is_none() {
        let mut summary = inspect(path).map_err(unreadable)?;
        compare_files(&mut summary, path, &access);
        batch.reads(&read(&access))?;
        judge_inputs(&mut summary);
        return Ok(summary);
    }
    let (mut summary, scalars) = scalars(path).map_err(unreadable)?;
    compare_files(&mut summary, path, &access);
    // Before anything is written: what the scenario names is an input, too.
    let setup = arguments.check.as_ref().map(|scenario| load(scenario, &summary, &access));
    batch.reads(&read(&access))?;
    if let Some(file) = &arguments.csv {
        replace("--csv", file, scalars_csv(&summary, &scalars), &read(&access))?;
    }
    let Some(setup) = setup else {
        judge_inputs(&mut summary);
        return Ok(summary);
    };
    // A file that is damaged or has no verdict shows nothing about its checks.
    if summary.exit_code == BAD_INPUT || summary.run.is_none() {
        summary.reason += "; its checks are not evaluated again";
        return Ok(summary);
    }
    let setup = setup?;
    batch.warn(path, &setup.warnings);
    let result = recheck(&summary, &scalars, &setup)
        .map_err(|error| Diagnostic::error(codes::inspect::CHECK, error.to_string()))?;
    take(&mut summary, result);
    Ok(summary)
}

/// Refuses what is no recording: nothing, a robot or a scenario.
fn refuse_other(path: &Path, in_folder: &Path) -> Result<(), Diagnostic> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let help = "give a recording (.rrd) or the folder of results that `congruent run SCENARIO` has written: out/NAME";
    if !path.exists() {
        return Err(Diagnostic::error(codes::inspect::RECORDING, absence(path)).with_help(help));
    }
    let why = if path.is_dir() && path.join("robot.toml").is_file() || ["urdf", "xml"].contains(&ending) {
        "is a robot"
    } else if ending == "toml" {
        "is a scenario or a robot"
    } else if path.is_dir() && !in_folder.exists() {
        "has no recording"
    } else {
        return Ok(());
    };
    let message = format!("{} {why}", path.display());
    Err(Diagnostic::error(codes::inspect::RECORDING, message).with_help(help))
}

/// The files of the run that were read to be compared.
fn read(access: &FileAccess) -> Vec<PathBuf> {
    access.files().into_iter().map(|file| file.path).collect()
}

/// Adds the result to what is printed.
fn take(summary: &mut RecordingSummary, result: Recheck) {
    let (before, code) = (summary.exit_code, result.exit_code());
    // Other limits have a verdict of their own.
    summary.exit_code = if result.same_limits || before == BROKEN { worse(before, code) } else { code };
    if let Some(first) = result.disagreements.first() {
        summary.reason = format!("the series contradict the report: {}", disagreement_sentence(first));
    } else if let Some(first) = result.samples.first() {
        summary.reason = format!("the samples are not those of the run: {first}");
    } else if !result.same_verdict {
        summary.reason = format!("{}; in the run {}", result.sentence(), summary.reason);
    } else if result.verdict != Verdict::Broken {
        summary.reason = result.sentence();
    }
    summary.recheck = Some(result);
}

/// The scenario with the values that replaced those of its file in the run.
fn load(scenario: &Path, summary: &RecordingSummary, access: &FileAccess) -> Result<RunSetup, Failure> {
    let overrides = summary.run.as_ref().map(overrides).transpose()?.unwrap_or_default();
    Ok(RunSetup::load_with(scenario, &overrides, access)?)
}
