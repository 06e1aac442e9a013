//! `congruent replay`: a log of the real robot through the checks of a run.

use std::path::{Path, PathBuf};

use congruent::{
    Headline, NamedBy,
    agreement::compare::{Agreement, CheckOptions},
    check_against,
    description::{RobotDescription, load_robot_with},
    input::{Diagnostic, FileAccess, Findings},
    logs::is_log,
    other_description,
    replay::{LEFT_OUT, ReplayDraft, ReplayRequest, in_folder, replay_draft, replay_text},
    results::files::write_whole,
    scenario::PoseOrigin,
};

use crate::{
    ci::CiArguments,
    codes,
    failure::{FAILED, Failure, unwritable, worse},
    input::AccessArguments,
    invocation,
    run::{arguments::RecordingArguments, log_arguments::LogArguments},
    terminal::{print::Printer, progress::waiting},
};

/// Judges a log of the real robot: writes a scenario that takes its joint states and poses, and runs it.
///
/// The log is an MCAP, a folder that rosbag2 wrote, a table in CSV or Parquet, or a dataset of LeRobot. A
/// `robot_description` in it is compared with the robot first. Joints are found by their names; poses by the names of
/// their topics and frames. Poses in frames that the robot does not have are fitted to the log, so that a constant
/// error of base or tool is not found. The scenario is written beside the results; `congruent run` runs it again. Exit
/// code 1 if a check fails or the recorded description is another robot.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A folder with robot.toml, a robot file, a URDF or an MJCF.
    robot: PathBuf,
    /// The log: an MCAP, a folder that rosbag2 wrote, a table in CSV or Parquet, or a dataset of LeRobot.
    log: PathBuf,
    /// Folder for the scenario and for its results.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Replace the scenario file of an earlier call, even if you have edited it.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    of_log: LogArguments,
    /// The topic with the commanded joint states, which the measured ones are compared with.
    #[arg(long, value_name = "TOPIC")]
    setpoint: Option<String>,
    /// Poses of this topic were measured, by a tracker or a camera. May be given several times.
    #[arg(long, value_name = "TOPIC")]
    measured_pose: Vec<String>,
    /// Poses of this topic were computed by the robot's controller. May be given several times.
    #[arg(long, value_name = "TOPIC")]
    controller_pose: Vec<String>,
    /// Poses of this topic were computed from the joint states by a URDF. May be given several times.
    #[arg(long, value_name = "TOPIC")]
    derived_pose: Vec<String>,
    #[command(flatten)]
    recording: RecordingArguments,
    #[command(flatten)]
    ci: CiArguments,
    #[command(flatten)]
    access: AccessArguments,
}

impl Arguments {
    /// Writes the scenario into the folder of the results, and returns its path.
    fn written(&self, draft: &ReplayDraft) -> Result<PathBuf, Failure> {
        let Self { out, force, .. } = self;
        let command = invocation::command();
        std::fs::create_dir_all(out).map_err(|error| {
            let message = format!("cannot create {}: {error}", out.display());
            Failure::Machine(message)
        })?;
        let scenario = in_folder(&draft.scenario, out)?;
        let path = out.join(format!("{}.toml", scenario.name));
        let text = replay_text(&scenario, &draft.taken, &command);
        let content =
            |text: &str| text.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join("\n");
        let is_other = std::fs::read_to_string(&path).is_ok_and(|there| content(&there) != content(&text));
        if path.exists() && is_other && !*force {
            let message = format!(
                "{} exists with other content, perhaps a check that somebody has added",
                path.display()
            );
            return Err(Diagnostic::error(codes::output::REFUSED, message)
            .with_help("give another folder with --out, or replace it with --force; `congruent run` runs it as it is")
            .into());
        }
        write_whole(&path, text.as_bytes()).map_err(|error| unwritable(&error, "--out"))?;
        Ok(path)
    }

    fn request(&self) -> ReplayRequest {
        let kinds = [
            (&self.measured_pose, PoseOrigin::Measured),
            (&self.controller_pose, PoseOrigin::Controller),
            (&self.derived_pose, PoseOrigin::Derived),
        ];
        let poses = kinds
            .into_iter()
            .flat_map(|(topics, origin)| topics.iter().map(move |topic| (topic.clone(), origin)));
        ReplayRequest { setpoint: self.setpoint.clone(), poses: poses.collect(), ..self.of_log.request() }
    }
}

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let Arguments { log, out, .. } = arguments;
    if log.exists() && !is_log(log) {
        let message = format!("{} is no log", log.display());
        return Err(Diagnostic::error(codes::run::LOG, message)
            .with_help("a log is an .mcap, a .csv or .tsv, or the folder of a bag")
            .into());
    }
    let access = arguments.access.access()?;
    let mut description = load_robot_with(&arguments.robot, &access)?;
    let draft =
        waiting(printer, "reading the log", || replay_draft(&description, log, &arguments.request()))?;
    let recorded = recorded_robot(&mut description, log, &draft, &access);
    let lines: Vec<String> =
        recorded.iter().map(|of| of.line.clone()).chain(draft.taken.iter().cloned()).collect();
    printer.notes(lines.iter().map(String::as_str));
    let scenario = arguments.written(&draft)?;
    let call = super::Arguments::for_replay(
        scenario,
        out.clone(),
        &arguments.recording,
        &arguments.ci,
        &arguments.access,
    );
    let exit_code = super::run(&call, printer)?;
    // Also with --quiet, and behind the verdict, which does not have them.
    for line in draft.taken.iter().filter(|line| line.starts_with(LEFT_OUT)) {
        printer.hint(&format!("not judged: {}", line.trim_start_matches(LEFT_OUT)));
    }
    let Some(recorded) = recorded.filter(|recorded| recorded.is_other) else { return Ok(exit_code) };
    printer.hint(&format!("FAIL: the robot_description in the log is not this robot: {}", recorded.line));
    Ok(worse(exit_code, FAILED))
}

/// What the description that was recorded with the joints says of the robot.
struct RecordedRobot {
    line: String,
    is_other: bool,
}

/// Compares the description in the log with the robot; `None` if there is none, or both cannot be compared.
fn recorded_robot(
    description: &mut RobotDescription,
    log: &Path,
    draft: &ReplayDraft,
    access: &FileAccess,
) -> Option<RecordedRobot> {
    let topic = &draft.survey.description.as_ref()?.topic;
    let mut compared = || -> Result<(Headline, bool), String> {
        let refused = |findings: Findings| findings.into_first().message;
        let other = other_description(description, log, NamedBy::Caller, access.clone()).map_err(refused)?;
        let checked = check_against(description, &other, &CheckOptions::default())
            .map_err(|error| error.to_string())?;
        Ok((checked.headline(), checked.geometry.verdict == Agreement::Disagree))
    };
    Some(match compared() {
        Ok((headline, is_other)) => RecordedRobot { line: format!("{topic}: {headline}"), is_other },
        Err(why) => {
            RecordedRobot { line: format!("{topic}: not compared with the robot: {why}"), is_other: false }
        }
    })
}
