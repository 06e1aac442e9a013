//! `congruent view`: opens the rerun viewer on a recording, on a robot whose joints move, or on a run.

use std::{
    fs,
    path::{Path, PathBuf},
};

use congruent::{
    PreparedScenario, SweepError,
    description::load_robot_with,
    input::Diagnostic,
    joint_sweep,
    page::PageFormat,
    recording::RerunFormat,
    results::{Options, RecordingFormat},
    text::joint_sweep_text,
    twin::RunError,
};

use super::viewer::Viewer;
use crate::{
    batch::BatchReport,
    codes,
    failure::Failure,
    input::AccessArguments,
    run::{no_folder, run_one},
    terminal::{
        print::{Printer, text_options},
        progress::ProgressLines,
    },
};

/// Opens the rerun viewer on a recording, on a robot with each joint moving over its range, or on the run of a scenario.
///
/// `rerun` must be in PATH. Without it the recording is still written, the message says how to install the viewer,
/// and the exit code is 3; --no-viewer only writes. Otherwise the exit code is 0, or that of the run if a scenario is
/// given.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A recording (.rrd), a robot (folder, robot file, URDF or MJCF), or a scenario file.
    input: PathBuf,
    /// Folder for the recording of a robot or the results of a scenario; each has a folder of its own in it.
    #[arg(long, default_value = "out", value_name = "DIR")]
    out: PathBuf,
    /// Only write the recording.
    #[arg(long)]
    no_viewer: bool,
    #[command(flatten)]
    access: AccessArguments,
}

/// Kind of the input, which decides how it is shown.
enum Input {
    Recording,
    Robot,
    Scenario,
}

impl Input {
    fn from_path(path: &Path) -> Result<Self, Diagnostic> {
        let ending = path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            _ if path.is_dir() => Ok(Self::Robot),
            Some("rrd") => Ok(Self::Recording),
            Some("urdf" | "xml") => Ok(Self::Robot),
            Some("toml") => Ok(if is_robot_file(path) { Self::Robot } else { Self::Scenario }),
            _ => {
                let message = format!("{} is not a recording, a robot or a scenario", path.display());
                Err(Diagnostic::error(codes::view::INPUT, message)
                    .with_help("give a file that ends in .rrd, .urdf or .toml, or the folder of a robot"))
            }
        }
    }
}

/// Whether a file names a URDF before its first section, as a robot file does. A file that cannot be read is reported
/// by its reader.
fn is_robot_file(path: &Path) -> bool {
    let text = fs::read_to_string(path).unwrap_or_default();
    let mut keys = text.lines().map(str::trim_start).take_while(|line| !line.starts_with('['));
    keys.any(|line| line.strip_prefix("urdf").is_some_and(|rest| rest.trim_start().starts_with('=')))
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    match Input::from_path(&arguments.input)? {
        Input::Recording => {
            // The viewer would open an empty window.
            let summary = congruent::recording::inspect(&arguments.input)
                .map_err(|error| Diagnostic::error(codes::view::RECORDING, error.to_string()))?;
            printer.notes(summary.problems.iter().map(String::as_str));
            open(&arguments.input, arguments, printer)?;
            Ok(0)
        }
        Input::Robot => {
            let description = load_robot_with(&arguments.input, &arguments.access.access()?)?;
            printer.warnings(None, &description.warnings);
            let sweep = joint_sweep(description, &arguments.out).map_err(refused)?;
            printer.result(&sweep, |sweep| joint_sweep_text(sweep, &text_options()))?;
            open(&sweep.recording, arguments, printer)?;
            Ok(0)
        }
        Input::Scenario => scenario(arguments, printer),
    }
}

fn refused(error: SweepError) -> Failure {
    match error {
        SweepError::Robot(findings) => findings.into(),
        SweepError::Folder(error) => no_folder(error),
        SweepError::Run(RunError::Recording(error)) => Failure::Machine(error.to_string()),
        error => Diagnostic::error(codes::view::ROBOT, error.to_string()).into(),
    }
}

fn scenario(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let scenario = PreparedScenario::load(&arguments.input, &[], &arguments.access.access()?)?;
    printer.warnings(None, &scenario.setup.description.warnings);
    printer.warnings(None, &scenario.setup.warnings);
    let options =
        Options { out: arguments.out.clone(), recordings: vec![&RerunFormat, &PageFormat], interrupt: None };
    let ran = run_one(&scenario, &options, &ProgressLines::new(printer))?;
    printer.result(&ran, BatchReport::text)?;
    let code = ran.exit_code();
    let Ok(folder) = &ran.results else { return Ok(code) };
    let recording = folder.join(RerunFormat.file_name());
    open(&recording, arguments, printer)?;
    Ok(code)
}

/// Opens a recording and waits until the viewer is closed.
fn open(recording: &Path, arguments: &Arguments, printer: &Printer) -> Result<(), Failure> {
    if arguments.no_viewer {
        return Ok(());
    }
    let viewer = Viewer::find(Some(recording))?;
    printer.notes(viewer.remark().as_deref());
    viewer.show(recording)
}
