//! `congruent run`: runs scenario files without a display.

mod kept;

use std::{
    fmt::Write,
    path::{Path, PathBuf},
    sync::{
        Mutex,
        atomic::{AtomicBool, Ordering},
    },
};

use congruent::{
    description::{Diagnostic, display::quantity},
    page::{IndexEntry, PageFormat, index_page},
    twin::{
        ExecuteError, Options, RecordingFormat, RunSetup,
        diagnosis::RunDiagnosis,
        execute,
        report::{Reason, RunReport, TestCase, TestResult, TestSuite, lines},
        results::{FolderError, write_whole},
        scenario::{CheckKind, Expectation, Override},
        source::ActuatorUse,
        verdict::{CheckResult, Status, Verdict},
    },
};
use serde::{Serialize, Serializer};

use self::kept::{Loaded, load};
#[cfg(feature = "recording")]
use crate::recording::{live::LiveFormat, viewer::Viewer};
use crate::{
    batch::{Answer, Batch, BatchReport},
    ci::CiArguments,
    failure::{BROKEN, Failure, unwritable},
    input::AccessArguments,
    interrupt::flag_of_signals,
    print::Printer,
    progress::Progress,
};

/// Runs scenario files and writes report, page, JUnit and recording of each to its own folder; of several an index of the
/// pages besides.
///
/// Ctrl-C and SIGTERM end the runs in order: what was computed until then is written, and the exit code is 3. The second
/// ends the call at once.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario files.
    #[arg(required = true)]
    scenarios: Vec<PathBuf>,
    /// Folder for results; each scenario gets a folder of its name in it.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Keep what an earlier call has left in the folder for scenarios that are finished and were made from the same files,
    /// values and version; run the others. Index, JUnit file and summary are of all.
    #[arg(long)]
    resume: bool,
    /// How many scenarios run at once; as many as the machine has cores if it is left out. The results are the same.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Replace a value of all scenarios, for example controller.stiffness=500 or check.1.position_m=1e-6.
    ///
    /// KEY is the keys of the file joined by dots; an entry of a list has its number, from 1. VALUE is TOML
    /// or a word. May be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_override)]
    overrides: Vec<Override>,
    /// Use this seed instead of the scenario's; the same as --set seed=N.
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX.unsigned_abs()))]
    seed: Option<u64>,
    #[command(flatten)]
    #[cfg_attr(not(feature = "recording"), expect(dead_code, reason = "without the feature there is none"))]
    recording: RecordingArguments,
    #[command(flatten)]
    ci: CiArguments,
    #[command(flatten)]
    access: AccessArguments,
}

/// What becomes of the recording.
#[derive(Debug, clap::Args)]
struct RecordingArguments {
    /// Write no recording.
    #[arg(long)]
    #[cfg_attr(not(feature = "recording"), expect(dead_code, reason = "without the feature there is none"))]
    no_recording: bool,
    /// Show the recording of one scenario in the rerun viewer while it is written; the viewer stays open.
    ///
    /// The recording is written every 1000 samples, 10 s of the run; its layout comes with its end.
    #[cfg(feature = "recording")]
    #[arg(long, conflicts_with = "no_recording")]
    view: bool,
}

fn parse_override(text: &str) -> Result<Override, String> {
    text.parse().map_err(|error: Diagnostic| {
        error.help.map_or(error.message.clone(), |help| format!("{}; {help}", error.message))
    })
}

impl Arguments {
    /// Number of threads for so many scenarios.
    fn threads(&self, scenarios: usize) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.jobs.map_or_else(cores, usize::from).min(scenarios)
    }

    fn overrides(&self) -> Vec<Override> {
        self.overrides.iter().cloned().chain(self.seed.map(Override::seed)).collect()
    }
}

/// A scenario that ran.
pub(crate) struct Ran {
    pub(crate) report: RunReport,
    /// Where its results are, or why they are not all on disk.
    pub(crate) results: Result<PathBuf, String>,
    /// Whether it ran in an earlier call.
    pub(crate) is_kept: bool,
}

impl Serialize for Ran {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.report.serialize(serializer)
    }
}

impl BatchReport for Ran {
    fn exit_code(&self) -> u8 {
        if self.results.is_ok() { self.report.exit_code } else { BROKEN }
    }

    fn text(&self) -> String {
        let results = match &self.results {
            Ok(folder) if self.is_kept => {
                format!("kept from an earlier call, results in {}", folder.display())
            }
            Ok(folder) => format!("results in {}", folder.display()),
            Err(_) => "results are not all on disk".to_owned(),
        };
        format!("{}  {results}\n", described(&self.report))
    }

    fn test_suite(&self, _: &str) -> TestSuite {
        let mut suite = self.report.test_suite();
        if let Err(message) = &self.results {
            let reason = Reason { kind: "machine".to_owned(), message: message.clone() };
            let result = TestResult::Error(reason);
            suite.cases.push(TestCase {
                name: "results".to_owned(),
                result,
                output: String::new(),
                place: None,
            });
        }
        suite
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let recording = recording_format(arguments, printer)?;
    let batch = Batch::begin(&arguments.scenarios, &arguments.ci, printer)?;
    let recordings = recordings(recording.as_deref());
    let options = Options { out: arguments.out.clone(), recordings, interrupt: None };
    let loaded = load(arguments, &options, &batch)?;
    batch.plan(&loaded, Loaded::suite);
    let interrupt = flag_of_signals();
    let progress = Progress::new(printer);
    let options = Options { interrupt: Some(&interrupt), ..options };
    let answers = run_all(loaded, (arguments, &interrupt), &options, (&batch, &progress));
    if arguments.resume {
        let kept = answers.iter().filter(|answer| answer.report().is_ok_and(|ran| ran.is_kept)).count();
        let note = format!("{kept} of {} kept from an earlier call", answers.len());
        printer.notes([note.as_str()]);
    }
    let written = write_index(&answers, &arguments.out);
    batch.finish_with_page(answers, written)
}

/// The page over several scenarios.
const INDEX: &str = "index.html";

/// The page over all scenarios of a call, beside their folders, if there are several and one of them ran.
fn write_index(answers: &[Answer<Ran>], out: &Path) -> Result<(), Failure> {
    if answers.len() < 2 || answers.iter().all(|answer| answer.report().is_err()) {
        return Ok(());
    }
    let entries: Vec<IndexEntry<'_>> = answers.iter().map(entry).collect();
    let page = index_page(&entries);
    write_whole(&out.join(INDEX), page.as_bytes())
        .map_err(|error| unwritable(&error, "choose a folder that can be written with --out"))
}

fn entry(answer: &Answer<Ran>) -> IndexEntry<'_> {
    let page = |ran: &Ran| {
        let folder = ran.results.as_ref().ok()?.file_name()?;
        Some(format!("{}/report.html", folder.to_string_lossy()))
    };
    IndexEntry {
        input: answer.input(),
        page: answer.report().ok().and_then(page),
        result: answer.report().map(|ran| &ran.report),
    }
}

/// Why there is no folder for results, and what to do.
pub(crate) fn no_folder(error: FolderError) -> Failure {
    let help = match error {
        FolderError::Output(error) => {
            return unwritable(&error, "choose a folder that can be written with --out");
        }
        FolderError::InUse { .. } => "wait for it, or give another folder with --out",
        _ => "give another folder with --out",
    };
    Diagnostic::error("run::output", error.to_string()).with_help(help).into()
}

/// Runs scenarios on `--jobs` threads; answers are in the order of the arguments.
fn run_all(
    loaded: Vec<Answer<Loaded>>,
    (arguments, interrupt): (&Arguments, &AtomicBool),
    options: &Options<'_>,
    (batch, progress): (&Batch<'_>, &Progress),
) -> Vec<Answer<Ran>> {
    let jobs = arguments.threads(loaded.len());
    let waiting = Mutex::new(loaded.into_iter().enumerate());
    let work = || {
        let mut answers = Vec::new();
        loop {
            let next = waiting.lock().expect("no thread panics while it takes a scenario").next();
            let Some((index, loaded)) = next else { return answers };
            let answer = batch.go_on(loaded, |loaded| match loaded {
                Loaded::Finished(report, folder) => {
                    Ok(Ran { report: *report, results: Ok(folder), is_kept: true })
                }
                Loaded::New(_) if interrupt.load(Ordering::Relaxed) => {
                    Err(Failure::Machine("interrupted before it started".to_owned()))
                }
                Loaded::New(setup) => run_one(&setup, options, progress),
            });
            batch.keep(index, &answer);
            progress.suspended(|| batch.tell(&answer));
            answers.push((index, answer));
        }
    };
    let mut answers: Vec<(usize, Answer<Ran>)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    answers.sort_by_key(|(index, _)| *index);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

/// The files that take the samples: the recording, and the page, which links to it.
fn recordings(recording: Option<&dyn RecordingFormat>) -> Vec<&dyn RecordingFormat> {
    recording.into_iter().chain([&PageFormat as &dyn RecordingFormat]).collect()
}

/// The format of recordings, if they are wanted and this command was built with one.
#[cfg(feature = "recording")]
fn recording_format(
    arguments: &Arguments,
    printer: &Printer,
) -> Result<Option<Box<dyn RecordingFormat>>, Failure> {
    if arguments.recording.no_recording {
        return Ok(None);
    }
    if !arguments.recording.view {
        return Ok(Some(Box::new(congruent::recording::RerunFormat)));
    }
    if arguments.scenarios.len() > 1 {
        let message = format!("--view shows one run, and there are {} scenarios", arguments.scenarios.len());
        return Err(Diagnostic::error("run::view", message).with_help("give one scenario").into());
    }
    let viewer = Viewer::find(None)?;
    printer.notes(viewer.remark().as_deref());
    Ok(Some(Box::new(LiveFormat(viewer))))
}

/// This command was built without recordings.
#[cfg(not(feature = "recording"))]
#[expect(clippy::unnecessary_wraps, reason = "with recordings it may fail")]
fn recording_format(_: &Arguments, _: &Printer) -> Result<Option<Box<dyn RecordingFormat>>, Failure> {
    Ok(None)
}

/// Runs a scenario and writes its results.
pub(crate) fn run_one(setup: &RunSetup, options: &Options<'_>, progress: &Progress) -> Result<Ran, Failure> {
    let progress = progress.of_run(setup);
    match execute(setup, options, |steps| progress.steps(steps)) {
        Ok((report, folder)) => Ok(Ran { report, results: Ok(folder.path().to_owned()), is_kept: false }),
        Err(ExecuteError::Lost { report, source }) => {
            Printer::explain(setup.path.as_deref(), &Failure::Machine(source.to_string()));
            Ok(Ran { report: *report, results: Err(source.to_string()), is_kept: false })
        }
        Err(ExecuteError::Folder(error)) => Err(no_folder(error)),
        Err(ExecuteError::Output(error)) => Err(no_folder(error.into())),
        Err(ExecuteError::Recording(error)) => Err(Failure::Machine(error.to_string())),
        Err(error) => Err(Diagnostic::error("run::cannot_run", error.to_string()).into()),
    }
}

fn described(report: &RunReport) -> String {
    let mut text = String::new();
    let verdict = match (report.verdict, &report.expected) {
        (Verdict::AsExpected, Expectation::Pass) => "pass".to_owned(),
        (Verdict::AsExpected, Expectation::Fail { .. }) => "pass (expected failure)".to_owned(),
        (Verdict::NotAsExpected, Expectation::Pass) => "FAIL".to_owned(),
        (Verdict::NotAsExpected, Expectation::Fail { checks }) => {
            format!("FAIL ({})", unexpected(report, checks))
        }
        (Verdict::NothingChecked, _) => "NOTHING CHECKED: add a [[check]]".to_owned(),
        (Verdict::Broken, _) => "BROKEN".to_owned(),
    };
    let _ = writeln!(
        text,
        "{}: {verdict} ({}, {} in {} steps)",
        report.scenario,
        report.robot,
        quantity(report.simulation.duration_s, "s"),
        report.simulation.steps
    );
    if let Some(error) = &report.error {
        let _ = writeln!(text, "  {error}");
    }
    for (index, motion) in report.motions.iter().enumerate() {
        if let Some(slowed) = &motion.slowed {
            let help = slowed.help.as_deref().unwrap_or_default();
            let _ = writeln!(text, "  motion {}   slowed: {}; {help}", index + 1, slowed.message);
        }
    }
    for servo in &report.servos {
        let _ = writeln!(text, "  motion {}   {servo}", servo.motion);
    }
    for check in report.checks_failed_first() {
        checked(&mut text, check);
    }
    let held_back = |used: &ActuatorUse| used.held_back(report.simulation.duration_s);
    for (index, held_back) in report.actuators.iter().filter_map(held_back).enumerate() {
        let _ = writeln!(text, "  {:10} {:7} {held_back}", if index == 0 { "actuators" } else { "" }, "");
    }
    for fault in &report.faults {
        let _ = writeln!(text, "  {:10} {:7} {}", "injected", "", fault.sentence());
    }
    for sentence in report.diagnosis.iter().flat_map(RunDiagnosis::sentences) {
        let _ = writeln!(text, "  {:10} {:7} {sentence}", "diagnosis", "");
    }
    text
}

/// Why a failure is not the expected one: what did not fail although it should, and what failed besides.
fn unexpected(report: &RunReport, expected: &[CheckKind]) -> String {
    let has_failed = |kind: &CheckKind| {
        report.checks.iter().any(|check| check.check == *kind && check.status == Status::Fail)
    };
    let listed = |kinds: Vec<&CheckKind>| kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>().join(", ");
    let missing: Vec<&CheckKind> = expected.iter().filter(|kind| !has_failed(kind)).collect();
    let mut besides: Vec<&CheckKind> = Vec::new();
    for CheckResult { check, .. } in report.checks.iter().filter(|check| check.status == Status::Fail) {
        if !expected.contains(check) && !besides.contains(&check) {
            besides.push(check);
        }
    }
    match (missing.is_empty(), besides.is_empty()) {
        _ if expected.is_empty() => "no check failed, and a failure was expected".to_owned(),
        (false, true) => format!("expected to fail, and did not: {}", listed(missing)),
        (true, _) => format!("failed besides the expected ones: {}", listed(besides)),
        (false, false) => {
            format!("expected to fail, and did not: {}; failed instead: {}", listed(missing), listed(besides))
        }
    }
}

fn checked(text: &mut String, check: &CheckResult) {
    for (index, line) in lines(check).iter().enumerate() {
        let (kind, status) = if index == 0 { (check.check.word(), check.status.word()) } else { ("", "") };
        let _ = writeln!(text, "  {kind:10} {status:7} {line}");
    }
}
