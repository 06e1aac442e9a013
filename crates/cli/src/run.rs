//! `congruent run`: runs scenario files without a display.

use std::{
    collections::BTreeMap,
    fmt::Write,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::Mutex,
};

use congruent::{
    description::Diagnostic,
    twin::{
        ExecuteError, Options, RecordingFormat, RunSetup, execute,
        report::{OutputError, OutputFolder, RunReport, sentence, write_junit},
        scenario::{Expectation, Override},
        verdict::{CheckResult, Verdict},
    },
};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::{
    failure::{BROKEN, Failure},
    input::PackageArguments,
    print::{Printer, Refusal},
};

/// Runs scenario files and writes report, JUnit and recording of each to its own folder.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario files.
    #[arg(required = true)]
    scenarios: Vec<PathBuf>,
    /// Folder for results; each scenario gets a folder of its name in it.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// How many scenarios run at once.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: u16,
    /// Replace a value of all scenarios, for example controller.stiffness=500 or check.1.position_m=1e-6.
    ///
    /// KEY is the keys of the file joined by dots; an entry of a list has its number, from 1. VALUE is TOML
    /// or a word. May be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_override)]
    overrides: Vec<Override>,
    /// Use this seed instead of the scenario's; the same as --set seed=N.
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX.unsigned_abs()))]
    seed: Option<u64>,
    /// Write no recording.
    #[arg(long)]
    no_recording: bool,
    /// Also write one JUnit file over all scenarios.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    #[command(flatten)]
    packages: PackageArguments,
}

fn parse_override(text: &str) -> Result<Override, String> {
    text.parse().map_err(|error: Diagnostic| {
        error.help.map_or(error.message.clone(), |help| format!("{}; {help}", error.message))
    })
}

impl Arguments {
    fn overrides(&self) -> Vec<Override> {
        self.overrides.iter().cloned().chain(self.seed.map(Override::seed)).collect()
    }
}

/// The result of one scenario.
enum Finished {
    /// It ran; its results are in the folder.
    Ran(Box<RunReport>, OutputFolder),
    /// It ran, but its results could not be written.
    Lost(Box<RunReport>, Failure),
    /// It could not run.
    Refused(Failure),
}

/// One scenario in the document that stands for several.
#[derive(Serialize)]
#[serde(untagged)]
enum Entry<'a> {
    Report(&'a RunReport),
    Refusal(Refusal<'a>),
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    if let Some(path) = &arguments.junit {
        // Finds out now whether it can be written, and replaces the file of an earlier run.
        write_junit(path, &[]).map_err(|error| unwritable(&error, "choose another file with --junit"))?;
    }
    let scenarios = load(arguments, printer)?;
    let mut finished = run_all(scenarios, arguments, printer);
    let mut code = finished.iter().map(Finished::exit_code).fold(0, worse);
    if let Some(path) = &arguments.junit {
        let reports: Vec<RunReport> = finished.iter().filter_map(Finished::report).cloned().collect();
        if let Err(error) = write_junit(path, &reports) {
            Printer::explain(&Failure::Machine(error.to_string()));
            code = BROKEN;
        }
    }
    if let [Finished::Refused(_)] = finished[..]
        && let Some(Finished::Refused(failure)) = finished.pop()
    {
        return Err(failure);
    }
    for failure in finished.iter().filter_map(Finished::failure) {
        Printer::explain(failure);
    }
    match &finished[..] {
        [one] => printer.result(&one.entry(), |_| one.described())?,
        all => {
            let entries: Vec<Entry<'_>> = all.iter().map(Finished::entry).collect();
            printer.result(&entries, |_| all.iter().map(Finished::described).collect())?;
        }
    }
    Ok(code)
}

impl Finished {
    fn report(&self) -> Option<&RunReport> {
        match self {
            Self::Ran(report, _) | Self::Lost(report, _) => Some(report),
            Self::Refused(_) => None,
        }
    }

    fn failure(&self) -> Option<&Failure> {
        match self {
            Self::Ran(..) => None,
            Self::Lost(_, failure) | Self::Refused(failure) => Some(failure),
        }
    }

    fn exit_code(&self) -> u8 {
        match self {
            Self::Ran(report, _) => report.exit_code,
            Self::Lost(_, failure) | Self::Refused(failure) => failure.exit_code(),
        }
    }

    fn entry(&self) -> Entry<'_> {
        match self {
            Self::Ran(report, _) | Self::Lost(report, _) => Entry::Report(report),
            Self::Refused(failure) => Entry::Refusal(failure.into()),
        }
    }

    fn described(&self) -> String {
        match self {
            Self::Ran(report, folder) => {
                format!("{}  results in {}\n", described(report), folder.path().display())
            }
            Self::Lost(report, _) => format!("{}  results are not all on disk\n", described(report)),
            Self::Refused(_) => String::new(),
        }
    }
}

/// Reads all scenarios before the first one runs, so that a fault in the last is known at once.
fn load(arguments: &Arguments, printer: &Printer) -> Result<Vec<RunSetup>, Failure> {
    let overrides = arguments.overrides();
    let mut scenarios = Vec::new();
    let mut findings = Vec::new();
    let mut folders: BTreeMap<PathBuf, PathBuf> = BTreeMap::new();
    for path in &arguments.scenarios {
        let setup = RunSetup::load_with(path, &overrides, &arguments.packages.ros());
        match setup.and_then(RunSetup::for_simulation) {
            Ok(setup) => {
                let folder = OutputFolder::path_for(&arguments.out, &setup.scenario.name);
                if let Some(other) = folders.insert(folder.clone(), path.clone()) {
                    findings.push(same_folder(&folder, &other, path));
                }
                printer.warnings(&setup.description.warnings);
                printer.warnings(&setup.warnings);
                scenarios.push(setup);
            }
            Err(errors) => findings.extend(errors),
        }
    }
    if findings.is_empty() { Ok(scenarios) } else { Err(findings.into()) }
}

fn same_folder(folder: &Path, a: &Path, b: &Path) -> Diagnostic {
    let message =
        format!("scenarios {} and {} would both write to {}", a.display(), b.display(), folder.display());
    Diagnostic::error("run::same_output", message).with_help("give them different names")
}

/// Runs scenarios on `--jobs` threads; results are in the order of the arguments.
fn run_all(scenarios: Vec<RunSetup>, arguments: &Arguments, printer: &Printer) -> Vec<Finished> {
    let options = Options {
        out: arguments.out.clone(),
        recording: (!arguments.no_recording).then_some(recording_format()).flatten(),
    };
    let bars = printer.is_interactive().then(MultiProgress::new);
    let jobs = usize::from(arguments.jobs).min(scenarios.len());
    let waiting = Mutex::new(scenarios.into_iter().enumerate());
    let work = || {
        let mut finished = Vec::new();
        loop {
            let next = waiting.lock().expect("no thread panics while it takes a scenario").next();
            let Some((index, scenario)) = next else { return finished };
            finished.push((index, run_one(&scenario, &options, bars.as_ref())));
        }
    };
    let mut finished: Vec<(usize, Finished)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    finished.sort_by_key(|(index, _)| *index);
    finished.into_iter().map(|(_, result)| result).collect()
}

/// The format of recordings, if this command was built with one.
#[cfg_attr(
    feature = "recording",
    expect(clippy::unnecessary_wraps, reason = "without the feature there is no format")
)]
fn recording_format() -> Option<&'static dyn RecordingFormat> {
    #[cfg(feature = "recording")]
    return Some(&congruent::recording::RerunFormat);
    #[cfg(not(feature = "recording"))]
    None
}

fn run_one(setup: &RunSetup, options: &Options<'_>, bars: Option<&MultiProgress>) -> Finished {
    /// Steps between two looks at the progress bar.
    const STEPS_A_TICK: u64 = 256;
    let bar = bars.map(|bars| bars.add(progress_bar(setup)));
    let name = setup.scenario.name.clone();
    let progress = |steps| {
        if let Some(bar) = bar.as_ref().filter(|_| steps % STEPS_A_TICK == 0) {
            bar.set_position(steps);
        }
    };
    // A panic in one scenario must not lose the results of the others.
    let result = catch_unwind(AssertUnwindSafe(|| execute(setup, options, progress)));
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    match result {
        Ok(Ok((report, folder))) => Finished::Ran(Box::new(report), folder),
        Ok(Err(ExecuteError::Lost { report, source })) => {
            Finished::Lost(report, Failure::Machine(source.to_string()))
        }
        Ok(Err(ExecuteError::Output(error))) => {
            Finished::Refused(unwritable(&error, "choose a folder that can be written with --out"))
        }
        Ok(Err(ExecuteError::Recording(error))) => Finished::Refused(Failure::Machine(error.to_string())),
        Ok(Err(error)) => Finished::Refused(Diagnostic::error("run::cannot_run", error.to_string()).into()),
        Err(_) => {
            let message = format!("scenario \"{name}\" ended in an internal error; please report it");
            Finished::Refused(Failure::Machine(message))
        }
    }
}

fn progress_bar(setup: &RunSetup) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix} {bar:40} {percent:>3} %")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(setup.clock.steps).with_style(style).with_prefix(setup.scenario.name.clone())
}

/// A path that cannot be written is bad input, a full disk is a failure of the machine.
fn unwritable(error: &OutputError, help: &str) -> Failure {
    if error.is_full() {
        return Failure::Machine(error.to_string());
    }
    Diagnostic::error("run::output", error.to_string()).with_help(help).into()
}

/// Of two exit codes the one that is returned: a broken run before bad input before a failed check.
fn worse(a: u8, b: u8) -> u8 {
    const FROM_BEST: [u8; 5] = [0, 1, 4, 2, 3];
    let rank = |code: u8| FROM_BEST.iter().position(|&known| known == code);
    if rank(b) > rank(a) { b } else { a }
}

fn described(report: &RunReport) -> String {
    let mut text = String::new();
    let verdict = match (report.verdict, &report.expected) {
        (Verdict::AsExpected, Expectation::Pass) => "pass",
        (Verdict::AsExpected, Expectation::Fail { .. }) => "pass (expected failure)",
        (Verdict::NotAsExpected, Expectation::Pass) => "FAIL",
        (Verdict::NotAsExpected, Expectation::Fail { .. }) => "FAIL (the expected failure did not occur)",
        (Verdict::NothingChecked, _) => "NOTHING CHECKED: add a [[check]]",
        (Verdict::Broken, _) => "BROKEN",
    };
    let _ = writeln!(
        text,
        "{}: {verdict} ({}, {:.3} s in {} steps)",
        report.scenario, report.robot, report.simulation.duration_s, report.simulation.steps
    );
    if let Some(error) = &report.error {
        let _ = writeln!(text, "  {error}");
    }
    for servo in &report.servos {
        let _ = writeln!(text, "  motion {}   {servo}", servo.motion);
    }
    for check in &report.checks {
        checked(&mut text, check);
    }
    text
}

fn checked(text: &mut String, check: &CheckResult) {
    let lines = check.measures.iter().map(sentence).chain(check.notes.clone());
    for (index, line) in lines.enumerate() {
        let (kind, status) = if index == 0 { (check.check.word(), check.status.word()) } else { ("", "") };
        let _ = writeln!(text, "  {kind:10} {status:7} {line}");
    }
}
