//! The scenario of a log: the joints and poses that it has of a robot.

use std::path::{Path, PathBuf};

use congruent_description::RobotDescription;
use congruent_input::{Capability, Diagnostic, Findings};
use congruent_logs::{JointSource, LogOptions, LogSurvey, PositionUnit, RobotOfLog, survey_log};
use congruent_scenario::{
    AgreementCheck, AngleUnit, Check, EffortCheck, JointRole, LimitsCheck, LoggedJointSettings,
    LoggedPoseSettings, PoseCheck, PoseOrigin, RecordingCheck, Scenario, SourceSettings, StepCheck,
    VelocityCheck,
};

use super::{
    fitted::fit,
    poses::{chosen_poses, keep_known_frames},
    replayed::Replayed,
    request::ReplayRequest,
    survey_words::rate,
};
use crate::codes;

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
    let whole = joints_draft(description, log, request)?;
    with_poses(description, whole, UnknownFrames::Fitted, request)
}

/// The same for a stream, of which the first messages are known. Nothing is fitted to what has not come yet: poses in frames that
/// the robot does not have are left out.
///
/// # Errors
/// What is asked for is not in them.
pub fn stream_draft(
    description: &RobotDescription,
    survey: LogSurvey,
    source: &str,
    request: &ReplayRequest,
) -> Result<ReplayDraft, Findings> {
    let whole =
        with_joints(description, survey, NamedLog { path: source, name: "watch".to_owned() }, request);
    with_poses(description, whole, UnknownFrames::LeftOut, request)
}

/// A log as its scenario names it, and the name of the scenario.
struct NamedLog<'a> {
    path: &'a str,
    name: String,
}

/// What becomes of poses in frames that the robot does not have.
#[derive(Debug, Clone, Copy)]
enum UnknownFrames {
    /// Their frames are fitted to the log.
    Fitted,
    /// They are not compared.
    LeftOut,
}

/// The joint states of a log, each topic named.
fn with_joints(
    description: &RobotDescription,
    survey: LogSurvey,
    log: NamedLog<'_>,
    request: &ReplayRequest,
) -> ReplayDraft {
    // The unit of a dataset is a guess that everything behind it depends on.
    let of_unit =
        survey.warnings.iter().filter(|warning| warning.code == congruent_logs::codes::log::MOTOR_UNITS.name);
    let mut taken: Vec<String> = of_unit.map(|warning| warning.message.clone()).collect();
    let mut source = SourceSettings::new(log.path.to_owned());
    (source.clock, source.rate_hz, source.episode) = (request.clock, request.rate_hz, request.episode);
    source.joints = joints(request, &survey, &mut taken);
    let scenario = Scenario {
        name: log.name,
        robot: description.path.display().to_string(),
        source: Some(source),
        ..Scenario::default()
    };
    ReplayDraft { scenario, taken, survey }
}

/// The same with the poses that the robot can be compared with, and with checks.
fn with_poses(
    description: &RobotDescription,
    ReplayDraft { mut scenario, mut taken, survey }: ReplayDraft,
    frames: UnknownFrames,
    request: &ReplayRequest,
) -> Result<ReplayDraft, Findings> {
    if let Some(source) = scenario.source.as_mut().filter(|source| is_found_again(request, &survey, source)) {
        source.joints.clear();
    }
    let mut poses = chosen_poses(description, request, &survey, &mut taken)?;
    match frames {
        UnknownFrames::Fitted => fit(&Replayed { description, scenario: &scenario }, &mut poses, &mut taken)?,
        UnknownFrames::LeftOut => keep_known_frames(description, &mut poses, &mut taken),
    }
    let is_left_out = |(topic, _): &&(String, _)| !poses.iter().any(|pose| pose.topic == *topic);
    if let Some((topic, _)) = request.poses.iter().find(is_left_out) {
        // It was asked for: to judge the rest would look like an answer.
        let why = taken.iter().find(|line| line.contains(topic.as_str())).cloned().unwrap_or_default();
        let error = Diagnostic::error(codes::replay::POSES, format!("poses of {topic} cannot be compared"));
        return Err(error.with_help(why).into());
    }
    scenario.check = checks(description, &survey, &poses);
    if let Some(source) = &mut scenario.source {
        source.pose = poses;
    }
    Ok(ReplayDraft { scenario, taken, survey })
}

/// The scenario of the joint states of a log alone, each topic named: without poses and checks.
pub(crate) fn joints_draft(
    description: &RobotDescription,
    log: &Path,
    request: &ReplayRequest,
) -> Result<ReplayDraft, Findings> {
    let names = description.robot.movable_joint_names().map(str::to_owned).collect();
    let options = LogOptions { rate_hz: request.rate_hz, episode: request.episode, joints: names };
    let survey = survey_log(log, &options, Some(&description.robot))?.survey;
    let named = NamedLog { path: &log.display().to_string(), name: name_of(log) };
    Ok(with_joints(description, survey, named, request))
}

/// The checks that robot and log allow, each with its default limits: in the scenario one can change them.
fn checks(description: &RobotDescription, survey: &LogSurvey, poses: &[LoggedPoseSettings]) -> Vec<Check> {
    let joints = || description.robot.movable_joints().iter().map(|&joint| description.robot.joint(joint));
    let has_velocities = survey.topics.iter().filter_map(|topic| topic.joints.as_ref());
    let has_velocities = has_velocities.into_iter().any(|joints| joints.without_velocities < joints.messages);
    let has_efforts = survey.topics.iter().filter_map(|topic| topic.joints.as_ref());
    let has_efforts = has_efforts.into_iter().any(|joints| joints.without_efforts < joints.messages);
    let has_masses = description.check_capability(Capability::Physics).is_ok();
    let is_measured = poses.iter().any(|pose| pose.origin == PoseOrigin::Measured);
    let all = [
        (true, Check::Recording(RecordingCheck::default())),
        // Without a table the model is the URDF, and there is nothing to compare it with.
        (description.dh.is_some(), Check::Agreement(AgreementCheck::default())),
        (joints().any(|joint| joint.limit.is_some()), Check::Limits(LimitsCheck::default())),
        (has_velocities, Check::Velocity(VelocityCheck::default())),
        (has_efforts && has_masses, Check::Effort(EffortCheck::default())),
        (!poses.is_empty(), Check::Pose(PoseCheck::default())),
        (is_measured, Check::Step(StepCheck::default())),
    ];
    all.into_iter().filter(|(is_allowed, _)| *is_allowed).map(|(_, check)| check).collect()
}

/// Parts of names of topics that are commanded.
const OF_SETPOINTS: [&str; 6] = ["desired", "command", "reference", "setpoint", "target", "goal"];

/// The topics of joints, as far as the log alone does not say which.
fn joints(request: &ReplayRequest, survey: &LogSurvey, taken: &mut Vec<String>) -> Vec<LoggedJointSettings> {
    let sources: Vec<&JointSource> = survey.robot.iter().flat_map(|of| &of.sources).collect();
    let of_topic = |topic: &str| sources.iter().find(|source| source.topic == topic).copied();
    let position = if request.degrees { AngleUnit::Deg } else { AngleUnit::Rad };
    let settings =
        |topic: &str| of_topic(topic).map_or_else(|| named(topic, position), |of| of_source(of, position));
    let setpoint = request.setpoint.clone().or_else(|| commanded(request, &sources));
    let mut chosen: Vec<LoggedJointSettings> = if let Some(topic) = &request.joints {
        vec![settings(topic)]
    } else {
        let measured = sources.iter().filter(|source| setpoint.as_ref() != Some(&source.topic));
        measured.map(|source| of_source(source, position)).collect()
    };
    for source in &chosen {
        let joints = of_topic(&source.topic).map_or(0, |of| of.joints.len());
        let rate = rate(survey, &source.topic);
        taken.push(format!("joint states: {} ({joints} joints of the robot){rate}", source.topic));
    }
    if let Some(topic) = &setpoint {
        chosen.push(LoggedJointSettings { role: JointRole::Setpoint, ..settings(topic) });
        taken.push(format!("setpoints: {topic}{}", rate(survey, topic)));
    }
    taken.extend(survey.robot.iter().flat_map(not_matched));
    // Degrees that nobody has stated are refused by the run, which then looks for the joints itself.
    let is_in_degrees = survey.robot.as_ref().is_some_and(|of| of.position_unit == PositionUnit::Degree);
    if !request.degrees && is_in_degrees { Vec::new() } else { chosen }
}

/// Whether the log says by itself which joints are which: then they are found again at each run, as of the next log of the same robot.
fn is_found_again(request: &ReplayRequest, survey: &LogSurvey, source: &SourceSettings) -> bool {
    let sources = survey.robot.iter().map(|of| of.sources.len()).sum::<usize>();
    let is_plain = |of: &LoggedJointSettings| {
        LoggedJointSettings { topic: of.topic.clone(), ..LoggedJointSettings::default() } == *of
    };
    request.joints.is_none() && source.joints.len() == sources && source.joints.iter().all(is_plain)
}

/// The topic that by its name is commanded, if it has joints that another one has.
fn commanded(request: &ReplayRequest, sources: &[&JointSource]) -> Option<String> {
    let is_commanded = |source: &JointSource| {
        let topic = source.topic.to_lowercase();
        OF_SETPOINTS.iter().any(|part| topic.contains(part))
    };
    let is_wanted = |source: &JointSource| request.joints.as_ref() != Some(&source.topic);
    let found = sources.iter().find(|source| is_commanded(source) && is_wanted(source))?;
    let has_another = sources.iter().any(|other| {
        other.topic != found.topic && other.joints.iter().any(|joint| found.joints.contains(joint))
    });
    has_another.then(|| found.topic.clone())
}

/// Joints of the robot that the log does not have, and joints beside them that are none of the robot.
fn not_matched(of: &RobotOfLog) -> impl Iterator<Item = String> {
    const MOST: usize = 8;
    let missing = (!of.missing.is_empty())
        .then(|| format!("not in the log, so taken to be at their start: {}", of.missing.join(", ")));
    let is_taken = |topic: &String| of.sources.iter().any(|source| source.topic == *topic);
    let unknown: Vec<&str> =
        of.unknown.iter().filter(|joint| is_taken(&joint.topic)).map(|joint| joint.name.as_str()).collect();
    let more = if unknown.len() > MOST { ", ..." } else { "" };
    let unknown = (!unknown.is_empty())
        .then(|| format!("none of the robot: {}{more}", unknown[..unknown.len().min(MOST)].join(", ")));
    missing.into_iter().chain(unknown)
}

fn of_source(source: &JointSource, position: AngleUnit) -> LoggedJointSettings {
    LoggedJointSettings {
        topic: source.topic.clone(),
        prefix: source.prefix.clone(),
        suffix: source.suffix.clone(),
        names: renamed(source),
        position,
        ..LoggedJointSettings::default()
    }
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
