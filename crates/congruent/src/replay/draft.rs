//! The scenario of a log: the joints and poses that it has of a robot.

use std::path::{Path, PathBuf};

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Findings};
use congruent_logs::{JointSource, LogOptions, LogSurvey, PositionUnit, survey_log};
use congruent_scenario::{AgreementCheck, AngleUnit, Check, LoggedJointSettings, Scenario, SourceSettings};

use super::{
    fitted::fit, poses::chosen_poses, replayed::Replayed, request::ReplayRequest, survey_words::rate,
};

/// A scenario for a log, and what of the log it takes.
#[derive(Debug, Clone)]
pub struct ReplayDraft {
    /// The scenario, with the paths as they were given.
    pub scenario: Scenario,
    /// What was found and taken, and what was left out and why, a line each.
    pub taken: Vec<String>,
    /// The survey of the log.
    pub survey: LogSurvey,
}

/// The scenario of a log for a robot: the joints and poses that the log has of it, and the checks that these allow.
///
/// # Errors
/// The log cannot be read, or what is asked for is not in it.
pub fn replay_draft(
    description: &RobotDescription,
    log: &Path,
    request: &ReplayRequest,
) -> Result<ReplayDraft, Findings> {
    let names = description.robot.movable_joint_names().map(str::to_owned).collect();
    let options = LogOptions { rate_hz: request.rate_hz, joints: names };
    let survey = survey_log(log, &options, Some(&description.robot))?.survey;
    let mut taken = Vec::new();
    let mut source = SourceSettings::new(log.display().to_string());
    (source.clock, source.rate_hz) = (request.clock, request.rate_hz);
    source.joints = joints(request, &survey, &mut taken);
    let mut poses = chosen_poses(description, request, &survey, &mut taken)?;
    let mut scenario = Scenario {
        name: name_of(log),
        robot: description.path.display().to_string(),
        source: Some(source),
        check: vec![Check::Agreement(AgreementCheck::default())],
        ..Scenario::default()
    };
    fit(&Replayed { description, scenario: &scenario }, &mut poses, &mut taken)?;
    if let Some(source) = &mut scenario.source {
        source.pose = poses;
    }
    Ok(ReplayDraft { scenario, taken, survey })
}

/// The topics of joints, as far as the log alone does not say which.
fn joints(request: &ReplayRequest, survey: &LogSurvey, taken: &mut Vec<String>) -> Vec<LoggedJointSettings> {
    let sources: Vec<&JointSource> = survey.robot.iter().flat_map(|of| &of.sources).collect();
    let of_topic = |topic: &str| sources.iter().find(|source| source.topic == topic).copied();
    let position = if request.degrees { AngleUnit::Deg } else { AngleUnit::Rad };
    let settings = |source: &JointSource| LoggedJointSettings {
        topic: source.topic.clone(),
        prefix: source.prefix.clone(),
        suffix: source.suffix.clone(),
        names: renamed(source),
        position,
        ..LoggedJointSettings::default()
    };
    let mut measured: Vec<LoggedJointSettings> = match &request.joints {
        Some(topic) => vec![of_topic(topic).map_or_else(|| named(topic, position), settings)],
        None => sources
            .iter()
            .filter(|source| request.setpoint.as_ref().is_none_or(|topic| *topic != source.topic))
            .map(|source| settings(source))
            .collect(),
    };
    for source in &measured {
        let joints = of_topic(&source.topic).map_or(0, |of| of.joints.len());
        taken.push(format!(
            "joint states: {} ({joints} joints of the robot){}",
            source.topic,
            rate(survey, &source.topic)
        ));
    }
    if let Some(topic) = &request.setpoint {
        let of = of_topic(topic).map_or_else(|| named(topic, position), settings);
        measured.push(LoggedJointSettings { role: congruent_scenario::JointRole::Setpoint, ..of });
        taken.push(format!("setpoints: {topic}{}", rate(survey, topic)));
    }
    let robot = survey.robot.iter();
    taken.extend(
        robot
            .filter(|of| !of.missing.is_empty())
            .map(|of| format!("not in the log, so at their start: {}", of.missing.join(", "))),
    );
    let is_plain = |of: &LoggedJointSettings| {
        LoggedJointSettings { topic: of.topic.clone(), ..LoggedJointSettings::default() } == *of
    };
    let is_clear = !sources.is_empty() && request.joints.is_none() && measured.iter().all(is_plain);
    // What the log says by itself is found again at each run, as for the next log of the same robot; degrees that nobody has
    // stated are refused there.
    let is_unstated =
        !request.degrees && survey.robot.as_ref().is_some_and(|of| of.position_unit == PositionUnit::Degree);
    if is_unstated || is_clear && measured.len() == sources.len() { Vec::new() } else { measured }
}

/// A topic of which the survey knows no joint of the robot: the run says what is wrong with it.
fn named(topic: &str, position: AngleUnit) -> LoggedJointSettings {
    LoggedJointSettings { topic: topic.to_owned(), position, ..LoggedJointSettings::default() }
}

/// Joints whose names in the robot begin with more than those in the log.
fn renamed(source: &JointSource) -> std::collections::BTreeMap<String, String> {
    let JointSource { prefix, suffix, prefix_of_robot, joints, .. } = source;
    let name = |joint: &String| {
        let own = joint.strip_prefix(prefix_of_robot.as_str()).unwrap_or(joint);
        (joint.clone(), format!("{prefix}{own}{suffix}"))
    };
    if prefix_of_robot.is_empty() {
        std::collections::BTreeMap::new()
    } else {
        joints.iter().map(name).collect()
    }
}

/// The name of a run of a log: that of its file, without what a folder may not be called.
fn name_of(log: &Path) -> String {
    let name = log.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let plain: String = name
        .chars()
        .map(|letter| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '_' })
        .collect();
    if plain.is_empty() { "replay".to_owned() } else { plain }
}

/// The same scenario as it reads in a folder: with relative paths.
///
/// # Errors
/// The folder, the robot or the log is not there.
pub fn in_folder(scenario: &Scenario, folder: &Path) -> Result<Scenario, Diagnostic> {
    let whole = |path: &Path| -> Result<PathBuf, Diagnostic> {
        path.canonicalize().map_err(|error| congruent_input::unreadable(path, &error))
    };
    let mut placed = scenario.clone();
    placed.robot = whole(Path::new(&scenario.robot))?.display().to_string();
    for file in placed.named_files_mut() {
        *file = whole(Path::new(&*file))?.display().to_string();
    }
    Ok(placed.relative_to(&whole(folder)?))
}
