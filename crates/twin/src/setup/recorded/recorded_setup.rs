//! `[source]` against the robot and against what the log has: which joints and poses a run takes.

use std::path::PathBuf;

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Diagnostics, direct_path};
use congruent_logs::{ClockKind, LogOptions, LogSurvey, StreamSelection, TopicSurvey, survey_log};
use congruent_monitors::{ComparedPoses, RunClock};
use congruent_scenario::{FilePlace, LogClock, Scenario, SourceSettings};
use nalgebra::Vector3;

use super::{
    joints::{ChosenJoints, choose},
    poses::poses,
};
use crate::{codes, setup::written_at::WrittenAt};

/// Gaps across which nothing is interpolated are at least this long, s. Kind: choice; a sample that is late by a period is none.
const SHORTEST_GAP_S: f64 = 0.02;
/// Periods of a topic that make a gap.
const PERIODS_OF_A_GAP: f64 = 5.0;
/// Stamps that are farther from the times of the recorder than this are on another clock, as that of a simulation: they count from
/// the first sample on.
const OTHER_CLOCK_S: f64 = 60.0;
/// Period of a topic of which it is not known, s.
const UNKNOWN_PERIOD_S: f64 = 0.01;

/// The log of a run, with every name resolved.
#[derive(Debug, Clone)]
pub struct RecordedSetup {
    /// The log.
    pub path: PathBuf,
    /// What is known beside it.
    pub options: LogOptions,
    /// What is taken from it.
    pub selection: StreamSelection,
    /// What the poses are compared with, by selection.
    pub poses: Vec<ComparedPoses>,
    /// What is in the log.
    pub survey: LogSurvey,
    /// The clock of the run: the period of its samples, and their number if no time is left out.
    pub clock: RunClock,
    /// Joints that the log does not have: they stay at their start.
    pub held: Vec<String>,
    /// Those of them that are between base and tip, and of which nobody has said that they stay there.
    pub unknown: Vec<String>,
}

impl RecordedSetup {
    /// Reads the log of a scenario once; `None` without one. What is wrong with it goes into `found`, what is suspicious into `warnings`.
    pub(in crate::setup) fn new(
        scenario: &Scenario,
        WrittenAt { place, folder, stream, .. }: WrittenAt<'_>,
        description: &RobotDescription,
        found: &mut Diagnostics,
        warnings: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let settings = scenario.source.as_ref()?;
        let place = place.key("source");
        let joints = description.robot.movable_joint_names().map(str::to_owned).collect();
        let options = LogOptions { rate_hz: settings.rate_hz, episode: settings.episode, joints };
        let (path, surveyed) = if let Some(surveyed) = stream {
            (PathBuf::from(&settings.log), surveyed.clone())
        } else {
            let path = direct_path(&folder.path.join(&settings.log));
            let surveyed = folder.access.note_log(&path);
            let surveyed = surveyed.and_then(|()| survey_log(&path, &options, Some(&description.robot)));
            (path, found.keep(surveyed.map_err(|error| place.key("log").mark(error)))?)
        };
        let survey = surveyed.survey;
        found.keep(in_order(settings, place));
        let chosen = choose(settings, place, &survey, &description.robot);
        if chosen.is_err() {
            // What is wrong with the log is often why it has no joint.
            found.extend(surveyed.warnings.iter().cloned());
        }
        let mut chosen = found.keep(chosen)?;
        for topic in &mut chosen.topics {
            topic.maximum_gap_s =
                settings.maximum_gap_s.unwrap_or_else(|| maximum_gap_s(settings, &survey, &topic.topic));
        }
        let clock = clock_of(settings, &survey, &chosen);
        let unknown = found.keep(unknown(settings, place, &chosen, description))?;
        let compared = found.keep(poses(settings, place, &survey, description))?;
        warnings.extend(surveyed.warnings);
        let selection = StreamSelection {
            clock,
            origin_s: origin_s(&survey, &chosen, clock),
            joints_of_row: description.robot.dof(),
            between_s: [
                settings.from_s.unwrap_or(f64::NEG_INFINITY),
                settings.until_s.unwrap_or(f64::INFINITY),
            ],
            poses: compared.iter().map(|(selected, _)| selected.clone()).collect(),
            joints: chosen.topics,
            is_live: stream.is_some(),
        };
        let first = survey.topics.iter().find(|topic| topic.name == selection.joints[0].topic);
        Some(Self {
            clock: RunClock {
                step_s: first.and_then(|topic| period_s(topic, settings)).unwrap_or(UNKNOWN_PERIOD_S),
                // How long a stream will be nobody knows.
                steps: first.filter(|_| stream.is_none()).map(|topic| topic.messages.saturating_sub(1)),
                gravity_in_world: Vector3::from(scenario.simulation.gravity_m_s2),
            },
            path,
            options,
            poses: compared.into_iter().map(|(_, frames)| frames).collect(),
            selection,
            survey,
            held: chosen.held,
            unknown,
        })
    }
}

/// Joints that decide where the tip is and of which nothing is known.
///
/// # Errors
/// A joint is said to be held that the robot does not have, or that the log has.
fn unknown(
    settings: &SourceSettings,
    place: FilePlace<'_>,
    chosen: &ChosenJoints,
    description: &RobotDescription,
) -> Result<Vec<String>, Diagnostic> {
    if let Some(name) = settings.held.iter().find(|name| !chosen.held.contains(name)) {
        let message = format!("held: \"{name}\" is no joint of the robot that the log lacks");
        let help = match &chosen.held[..] {
            [] => "the log has every joint: remove `held`".to_owned(),
            held => format!("it lacks {}", held.join(", ")),
        };
        let error = Diagnostic::error(codes::scenario::LOGGED_JOINTS, message).with_help(help);
        return Err(place.key("held").mark(error));
    }
    let names: Vec<&str> = description.robot.movable_joint_names().collect();
    let on_chain: Vec<&str> = description.moving_coordinates().into_iter().map(|at| names[at]).collect();
    let is_unknown = |name: &&String| on_chain.contains(&name.as_str()) && !settings.held.contains(name);
    Ok(chosen.held.iter().filter(is_unknown).cloned().collect())
}

/// Whether the part of the log that is taken begins before it ends.
fn in_order(settings: &SourceSettings, place: FilePlace<'_>) -> Result<(), Diagnostic> {
    let (Some(from_s), Some(until_s)) = (settings.from_s, settings.until_s) else { return Ok(()) };
    if from_s < until_s {
        return Ok(());
    }
    let message = format!("from_s = {from_s} is not before until_s = {until_s}");
    Err(place.key("until_s").mark(Diagnostic::error(codes::scenario::LOGGED_NOTHING, message)))
}

/// Stamps, if the topic of the first joints has them and no other clock is wanted.
fn clock_of(settings: &SourceSettings, survey: &LogSurvey, chosen: &ChosenJoints) -> ClockKind {
    match settings.clock {
        Some(LogClock::Log) => ClockKind::Log,
        Some(LogClock::Stamp) => ClockKind::Stamp,
        None => {
            let first = survey.topics.iter().find(|topic| topic.name == chosen.topics[0].topic);
            first.and_then(|topic| topic.times.as_ref()).map_or(ClockKind::Log, |times| times.clock)
        }
    }
}

/// The time that counts as 0: that of the first message of the log, as in `describe`; or the first stamp, on another clock.
fn origin_s(survey: &LogSurvey, chosen: &ChosenJoints, clock: ClockKind) -> f64 {
    let of_joints = |topic: &&TopicSurvey| chosen.topics.iter().any(|of| of.topic == topic.name);
    let times = survey.topics.iter().filter(of_joints).filter_map(|topic| topic.times.as_ref());
    let first_s = times.map(|times| times.from_s).fold(f64::INFINITY, f64::min);
    let is_other_clock = clock == ClockKind::Stamp && first_s.is_finite() && first_s.abs() > OTHER_CLOCK_S;
    if is_other_clock { first_s } else { 0.0 }
}

/// The period of a topic: as it is found, or as the scenario says for messages of which there are too few yet.
fn period_s(topic: &TopicSurvey, settings: &SourceSettings) -> Option<f64> {
    let found = topic.times.as_ref().and_then(|times| times.period_s).filter(|period_s| *period_s > 0.0);
    found.or_else(|| settings.rate_hz.map(|rate_hz| 1.0 / rate_hz))
}

/// Five periods of a topic.
fn maximum_gap_s(settings: &SourceSettings, survey: &LogSurvey, topic: &str) -> f64 {
    let topic = survey.topics.iter().find(|of| of.name == topic);
    topic
        .and_then(|topic| period_s(topic, settings))
        .map_or(SHORTEST_GAP_S, |period_s| (PERIODS_OF_A_GAP * period_s).max(SHORTEST_GAP_S))
}
