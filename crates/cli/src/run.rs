//! `congruent run`: scenarios, headless.

use std::{collections::BTreeMap, fmt::Write, path::PathBuf, sync::Mutex};

use congruent_description::Diagnostic;
use congruent_twin::{
    ExecuteError, Options, execute,
    report::{OutputError, OutputFolder, RunReport, sentence, write_junit},
    scenario::{Overrides, Scenario},
    verdict::{CheckResult, Expectation, Verdict},
};
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use crate::{failure::Failure, print::Printer};

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
    /// Use this seed instead of the scenario's.
    #[arg(long)]
    seed: Option<u64>,
    /// Write no recording.
    #[arg(long)]
    no_recording: bool,
    /// Also write one JUnit file over all scenarios.
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

/// What became of one scenario.
type Finished = Result<(RunReport, OutputFolder), Failure>;

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let scenarios = load(arguments, printer)?;
    let finished = run_all(scenarios, arguments, printer);
    let mut code = 0;
    let mut reports = Vec::new();
    let mut folders = Vec::new();
    for result in finished {
        match result {
            Ok((report, folder)) => {
                code = worse(code, report.exit_code);
                reports.push(report);
                folders.push(folder);
            }
            // One scenario that cannot run takes nothing from the others.
            Err(failure) => {
                printer.failure(&failure);
                code = worse(code, failure.exit_code());
            }
        }
    }
    if let Some(path) = &arguments.junit {
        write_junit(path, &reports).map_err(|error| unwritable(&error))?;
    }
    let text = |report: &RunReport, folder: &OutputFolder| described(report, folder);
    match (&reports[..], &folders[..]) {
        ([], _) => {}
        ([report], [folder]) => printer.result(report, |report| text(report, folder))?,
        (reports, folders) => printer.result(&reports, |reports| {
            reports.iter().zip(folders).map(|(report, folder)| text(report, folder)).collect()
        })?,
    }
    Ok(code)
}

/// Reads all scenarios before the first one runs, so that a slip in the last is known at once.
fn load(arguments: &Arguments, printer: &Printer) -> Result<Vec<Scenario>, Failure> {
    let overrides = Overrides { seed: arguments.seed };
    let mut scenarios = Vec::new();
    let mut findings = Vec::new();
    let mut folders: BTreeMap<PathBuf, PathBuf> = BTreeMap::new();
    for path in &arguments.scenarios {
        match Scenario::load(path, overrides) {
            Ok(scenario) => {
                let folder = OutputFolder::path_for(&arguments.out, &scenario.name);
                if let Some(other) = folders.insert(folder.clone(), path.clone()) {
                    findings.push(same_folder(&folder, &other, path));
                }
                printer.warnings(&scenario.description.warnings);
                printer.warnings(&scenario.warnings);
                scenarios.push(scenario);
            }
            Err(errors) => findings.extend(errors),
        }
    }
    if findings.is_empty() { Ok(scenarios) } else { Err(findings.into()) }
}

fn same_folder(folder: &std::path::Path, a: &std::path::Path, b: &std::path::Path) -> Diagnostic {
    let message =
        format!("scenarios {} and {} would both write to {}", a.display(), b.display(), folder.display());
    Diagnostic::error("run::same_output", message).with_help("give them different names")
}

/// Runs scenarios on `--jobs` threads; results are in the order of the arguments.
fn run_all(scenarios: Vec<Scenario>, arguments: &Arguments, printer: &Printer) -> Vec<Finished> {
    let options = Options { out: arguments.out.clone(), recording: !arguments.no_recording };
    let bars = printer.is_interactive().then(MultiProgress::new);
    let jobs = usize::from(arguments.jobs).min(scenarios.len());
    let waiting = Mutex::new(scenarios.into_iter().enumerate());
    let work = || {
        let mut finished = Vec::new();
        loop {
            let next = waiting.lock().expect("no thread panics while it takes a scenario").next();
            let Some((index, scenario)) = next else { return finished };
            finished.push((index, run_one(scenario, &options, bars.as_ref())));
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

fn run_one(scenario: Scenario, options: &Options, bars: Option<&MultiProgress>) -> Finished {
    /// Steps between two looks at the progress bar.
    const STEPS_A_TICK: u64 = 256;
    let bar = bars.map(|bars| bars.add(progress_bar(&scenario)));
    let result = execute(scenario, options, |steps| {
        if let Some(bar) = bar.as_ref().filter(|_| steps % STEPS_A_TICK == 0) {
            bar.set_position(steps);
        }
    });
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    result.map_err(|error| match error {
        ExecuteError::Output(error) => unwritable(&error),
        ExecuteError::Recording(error) => Failure::Machine(error.to_string()),
        error => Diagnostic::error("run::cannot_run", error.to_string()).into(),
    })
}

fn progress_bar(scenario: &Scenario) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix} {bar:40} {percent:>3} %")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(scenario.simulation.steps).with_style(style).with_prefix(scenario.name.clone())
}

fn unwritable(error: &OutputError) -> Failure {
    if error.is_full() {
        return Failure::Machine(error.to_string());
    }
    Diagnostic::error("run::output", error.to_string())
        .with_help("choose a folder that can be written with --out")
        .into()
}

/// Of two exit codes the one that is told: a broken run before bad input before a failed check.
fn worse(a: u8, b: u8) -> u8 {
    const FROM_BEST: [u8; 5] = [0, 1, 4, 2, 3];
    let rank = |code: u8| FROM_BEST.iter().position(|&known| known == code);
    if rank(b) > rank(a) { b } else { a }
}

fn described(report: &RunReport, folder: &OutputFolder) -> String {
    let mut text = String::new();
    let verdict = match (report.verdict, &report.expected) {
        (Verdict::AsExpected, Expectation::Pass) => "pass",
        (Verdict::AsExpected, Expectation::Fail { .. }) => "pass: it fails as expected",
        (Verdict::NotAsExpected, Expectation::Pass) => "FAIL",
        (Verdict::NotAsExpected, Expectation::Fail { .. }) => "FAIL: it should have failed otherwise",
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
    for check in &report.checks {
        checked(&mut text, check);
    }
    let _ = writeln!(text, "  results in {}", folder.path().display());
    text
}

fn checked(text: &mut String, check: &CheckResult) {
    let lines = check.measures.iter().map(sentence).chain(check.notes.clone());
    for (index, line) in lines.enumerate() {
        let (kind, status) = if index == 0 { (check.check, check.status.word()) } else { ("", "") };
        let _ = writeln!(text, "  {kind:10} {status:7} {line}");
    }
}
