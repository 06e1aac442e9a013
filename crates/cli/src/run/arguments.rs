//! The arguments of `congruent run`.

use std::path::PathBuf;

use congruent::{input::Override, page::PageFormat, results::RecordingFormat};

use crate::{ci::CiArguments, failure::Failure, input::AccessArguments, terminal::print::Printer};

#[cfg(feature = "recording")]
use crate::recording::{live::LiveFormat, viewer::Viewer};

/// Runs scenario files and writes report, page, JUnit and recording of each to its own folder, and, for several, an
/// index page.
///
/// Ctrl-C and SIGTERM end the runs in order: what was computed until then is written, and the exit code is 3. The second
/// ends the call at once.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Arguments {
    /// Scenario files (.toml) to run.
    #[arg(required = true)]
    pub(super) scenarios: Vec<PathBuf>,
    /// Folder for results; each scenario gets a folder of its name in it.
    #[arg(long, default_value = "out")]
    pub(super) out: PathBuf,
    /// Keep the results of an earlier call for scenarios that finished with the same files, values and version; run
    /// the others, and those again whose report names the cause of a failed agreement. Index, JUnit file and summary
    /// cover all scenarios.
    #[arg(long)]
    pub(super) resume: bool,
    /// Number of scenarios, or of cases of one, that run at once; by default the number of cores. The results do not depend on
    /// it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    jobs: Option<u16>,
    /// Replace a value of all scenarios, for example controller.stiffness=500 or check.1.position_m=1e-6.
    ///
    /// KEY is the keys of the file joined by dots; an entry of a list has its number, from 1, or its kind, name or joint; a key that
    /// begins with robot. is one of the robot. VALUE is TOML or a word, in the unit of the key. May be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = Override::of_argument)]
    overrides: Vec<Override>,
    /// Use this seed instead of the scenario's; the same as --set seed=N.
    #[arg(long, value_parser = clap::value_parser!(u64).range(..=i64::MAX.unsigned_abs()))]
    seed: Option<u64>,
    #[command(flatten)]
    pub(super) faults: FaultArguments,
    #[command(flatten)]
    recording: RecordingArguments,
    #[command(flatten)]
    pub(super) ci: CiArguments,
    #[command(flatten)]
    pub(super) access: AccessArguments,
}

/// What is shown of scenarios that inject faults.
#[derive(Debug, Default, Clone, clap::Args)]
pub(super) struct FaultArguments {
    /// Write no results; show which checks detect which injected fault, after what time, and what the diagnosis finds.
    ///
    /// Exit code 1 if a fault is detected by no check or is not diagnosed, or if a check fails in a scenario without a
    /// fault.
    #[arg(long, conflicts_with_all = ["out", "resume", "jobs", "no_recording", "junit", "summary", "annotate"])]
    pub(super) faults: bool,
    /// Also write the table of --faults into this file, between the lines `<!-- faults: begin -->` and `<!-- faults: end -->`.
    #[arg(long, value_name = "FILE", requires = "faults")]
    pub(super) markdown: Option<PathBuf>,
}

/// Whether a recording is written, and whether it is shown.
#[derive(Debug, Default, Clone, clap::Args)]
pub(crate) struct RecordingArguments {
    /// Write no recording (recording.rrd).
    #[arg(long)]
    no_recording: bool,
    /// Show the recording of one scenario in the rerun viewer while it is written; the viewer stays open.
    ///
    /// The recording is written every 1000 samples, 10 s of the run; its layout comes with its end.
    #[cfg(feature = "recording")]
    #[arg(long, conflicts_with = "no_recording")]
    view: bool,
}

impl Arguments {
    /// The call that runs the scenario of a log.
    pub(super) fn for_replay(
        scenario: PathBuf,
        out: PathBuf,
        recording: &RecordingArguments,
        ci: &CiArguments,
        access: &AccessArguments,
    ) -> Self {
        Self {
            scenarios: vec![scenario],
            out,
            resume: false,
            jobs: None,
            overrides: Vec::new(),
            seed: None,
            faults: FaultArguments::default(),
            recording: recording.clone(),
            ci: ci.clone(),
            access: access.clone(),
        }
    }

    /// The same call with these scenarios.
    pub(super) fn of(&self, scenarios: Vec<PathBuf>) -> Self {
        Self { scenarios, ..self.clone() }
    }

    /// Number of threads for this number of scenarios.
    pub(super) fn threads(&self, scenarios: usize) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.jobs.map_or_else(cores, usize::from).min(scenarios)
    }

    /// Number of threads for the cases of each of so many scenarios that run at once.
    pub(super) fn case_threads(&self, scenarios: usize) -> usize {
        (self.threads(usize::MAX) / scenarios.max(1)).max(1)
    }

    pub(super) fn overrides(&self) -> Vec<Override> {
        self.overrides.iter().cloned().chain(self.seed.map(Override::seed)).collect()
    }
}

/// The files that take the samples: the recording, and the page, which links to it.
pub(super) fn recordings(recording: Option<&dyn RecordingFormat>) -> Vec<&dyn RecordingFormat> {
    recording.into_iter().chain([&PageFormat as &dyn RecordingFormat]).collect()
}

/// The format of recordings, if they are wanted and this command was built with one.
#[cfg(feature = "recording")]
pub(super) fn recording_format(
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
        let message = format!("--view shows one run, but {} scenarios are given", arguments.scenarios.len());
        return Err(congruent::input::Diagnostic::error(crate::codes::run::VIEW, message)
            .with_help("give one scenario")
            .into());
    }
    let viewer = Viewer::find(None)?;
    printer.notes(viewer.remark().as_deref());
    Ok(Some(Box::new(LiveFormat(viewer))))
}

/// This command was built without recordings.
#[cfg(not(feature = "recording"))]
#[expect(clippy::unnecessary_wraps, reason = "with recordings it may fail")]
pub(super) fn recording_format(
    _: &Arguments,
    _: &Printer,
) -> Result<Option<Box<dyn RecordingFormat>>, Failure> {
    Ok(None)
}
