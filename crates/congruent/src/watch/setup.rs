//! From the first messages of a stream to what judges it.

use std::path::{Path, PathBuf};

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, FileAccess, Findings, Override};
use congruent_live_report::{ComparedStream, WatchStart};
use congruent_logs::{HeadRate, LiveReader, survey_head};
use congruent_scenario::OnViolation;
use congruent_twin::{RunSetup, setup::RecordedSetup};

use crate::{
    codes,
    replay::{ReplayRequest, stream_draft},
};

/// What a person says of a stream.
#[derive(Debug, Clone, Default)]
pub struct WatchRequest {
    /// What the stream comes from, as it is called in answers.
    pub source: String,
    /// What is known of it beside its messages.
    pub replay: ReplayRequest,
    /// The scenario whose checks are used; by default those that the stream allows.
    pub scenario: Option<PathBuf>,
    /// Whether the first violation of any check ends the run.
    pub is_until_violation: bool,
}

/// What judges a stream.
#[derive(Debug)]
pub struct WatchSetup {
    /// The checked scenario.
    pub setup: RunSetup,
    /// What was taken of the stream, and what was left out and why, a line each.
    pub taken: Vec<String>,
}

impl WatchSetup {
    /// Listens to the first messages of a stream, and finds in them what is judged.
    ///
    /// # Errors
    /// The stream has no joint of the robot, or the scenario is wrong.
    pub fn listen(
        reader: &mut LiveReader,
        description: RobotDescription,
        request: &WatchRequest,
        access: &FileAccess,
    ) -> Result<Self, Findings> {
        let has_rate = if request.replay.rate_hz.is_some() { HeadRate::Known } else { HeadRate::Unknown };
        let surveyed = survey_head(Path::new(&request.source), reader, &description.robot, has_rate)?;
        if surveyed.survey.messages == 0 {
            let message = format!("{} ended before its first message", request.source);
            return Err(Diagnostic::error(codes::watch::EMPTY, message)
                .with_help("a line is {\"time_s\": 1.25, \"q\": {\"elbow_joint\": 0.4}}")
                .into());
        }
        let (mut setup, taken) = if let Some(path) = &request.scenario {
            let overrides = overrides(&description, &request.source)?;
            (RunSetup::load_live(path, &overrides, access, &surveyed)?, Vec::new())
        } else {
            let draft =
                stream_draft(&description, surveyed.survey.clone(), &request.source, &request.replay)?;
            (RunSetup::new_live(draft.scenario, description, &surveyed)?, draft.taken)
        };
        if setup.recorded.is_none() {
            return Err(Diagnostic::error(
                codes::watch::SOURCE,
                "the scenario has no [source]: it is of a simulation",
            )
            .with_help("add [source] with log = \"stream\", and remove [controller] and [[motion]]")
            .into());
        }
        if request.is_until_violation {
            setup.scenario.check.iter_mut().for_each(|check| *check.on_violation_mut() = OnViolation::Stop);
        }
        Ok(Self { setup, taken })
    }

    /// The first line of the answer.
    pub fn start(&self, recorded: &RecordedSetup) -> WatchStart {
        let robot = &self.setup.description.robot;
        let names: Vec<&str> = robot.movable_joint_names().collect();
        let measured = recorded.selection.joints.iter().filter(|topic| !topic.is_setpoint);
        let mut joints: Vec<usize> =
            measured.flat_map(|topic| topic.joints.iter().map(|of| of.joint)).collect();
        joints.sort_unstable();
        let first = recorded.selection.joints.first();
        let times = first.and_then(|first| recorded.survey.topics.iter().find(|of| of.name == first.topic));
        let stated_hz = self.setup.scenario.source.as_ref().and_then(|source| source.rate_hz);
        WatchStart {
            source: recorded.path.display().to_string(),
            robot: self.setup.description.name.clone(),
            scenario: self.setup.scenario.name.clone(),
            joints: joints.into_iter().map(|joint| names[joint].to_owned()).collect(),
            held: recorded.held.clone(),
            rate_hz: times.and_then(|topic| topic.times.as_ref()?.rate_hz).or(stated_hz),
            maximum_gap_s: recorded.selection.maximum_gap_s(),
            poses: recorded
                .poses
                .iter()
                .map(|poses| ComparedStream { name: poses.name.clone(), origin: poses.origin })
                .collect(),
            checks: self.setup.scenario.check.iter().map(congruent_scenario::Check::kind).collect(),
            taken: self.taken.clone(),
        }
    }
}

/// The robot and the stream in place of what the scenario names.
fn overrides(description: &RobotDescription, source: &str) -> Result<Vec<Override>, Diagnostic> {
    let robot = &description.path;
    let robot = robot.canonicalize().map_err(|error| congruent_input::unreadable(robot, &error))?;
    [("robot", robot.display().to_string()), ("source.log", source.to_owned())]
        .into_iter()
        .map(|(key, value)| format!("{key} = {value:?}").parse())
        .collect()
}
