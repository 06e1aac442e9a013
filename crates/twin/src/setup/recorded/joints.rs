//! Which topics and joints of a log are the joints of the robot.

use std::{collections::BTreeMap, fmt::Write};

use congruent_description::{JointKind, Robot};
use congruent_input::{Diagnostic, Findings, known_names};
use congruent_logs::{
    JointSource, LogSurvey, PositionUnit, SelectedJoint, SelectedJoints, TopicContent, TopicSurvey,
};
use congruent_scenario::{
    AngleUnit, FilePlace, JointRole, LoggedEffort, LoggedJointSettings, SourceSettings,
};

use crate::codes;

/// The joints that are taken from a log.
#[derive(Debug)]
pub(super) struct ChosenJoints {
    /// The topic with the measured states of the most joints first: its times are those of the samples.
    pub(super) topics: Vec<SelectedJoints>,
    /// Joints of the robot that no topic has.
    pub(super) held: Vec<String>,
}

/// The joints that a scenario names, or else all that the log has of the robot.
///
/// # Errors
/// The log has no joint of the robot, or two topics have the same one, or what the scenario names is not there.
pub(super) fn choose(
    settings: &SourceSettings,
    place: FilePlace<'_>,
    survey: &LogSurvey,
    robot: &Robot,
) -> Result<ChosenJoints, Findings> {
    let topics = if settings.joints.is_empty() {
        all(place, survey, robot)?
    } else {
        named(settings, place, survey, robot)?
    };
    let mut measured: Vec<SelectedJoints> = topics;
    measured.sort_by_key(|topic| (topic.is_setpoint, std::cmp::Reverse(topic.joints.len())));
    if measured.first().is_none_or(|topic| topic.is_setpoint) {
        let message = "the log gives setpoints only: there are no measured joint states to judge";
        let help = "give a [[source.joints]] with role = \"measured\"";
        return Err(place
            .mark(Diagnostic::error(codes::scenario::LOGGED_JOINTS, message).with_help(help))
            .into());
    }
    let is_taken = |joint: usize| {
        let mut of_measured = measured.iter().filter(|topic| !topic.is_setpoint);
        of_measured.any(|topic| topic.joints.iter().any(|taken| taken.joint == joint))
    };
    let joints = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).enumerate();
    let held = joints.filter(|(at, joint)| joint.mimic.is_none() && !is_taken(*at));
    let held = held.map(|(_, joint)| joint.name.clone()).collect();
    Ok(ChosenJoints { topics: measured, held })
}

/// All joints of the robot that the log has.
fn all(place: FilePlace<'_>, survey: &LogSurvey, robot: &Robot) -> Result<Vec<SelectedJoints>, Findings> {
    let sources = survey.robot.iter().flat_map(|of| &of.sources).collect::<Vec<_>>();
    if sources.is_empty() {
        return Err(place.key("log").mark(no_joint(survey, robot)).into());
    }
    if let Some(joint) = twice(&sources) {
        return Err(place.key("log").mark(on_two_topics(&sources, joint)).into());
    }
    if survey.robot.as_ref().is_some_and(|of| of.position_unit == PositionUnit::Degree) {
        let message =
            "the positions are beyond the limits of the joints as radians, and within them as degrees";
        let topics = sources.iter().map(|source| written(source, Some("deg"))).collect::<Vec<_>>();
        let help = format!(
            "if they are degrees, `replay` takes --degrees, and a scenario has\n{}",
            topics.join("\n")
        );
        return Err(place
            .key("log")
            .mark(Diagnostic::error(codes::scenario::LOGGED_UNIT, message).with_help(help))
            .into());
    }
    let selected = |source: &&JointSource| SelectedJoints {
        topic: source.topic.clone(),
        is_setpoint: false,
        maximum_gap_s: 0.0,
        effort_is_torque: false,
        joints: source.joints.iter().filter_map(|joint| selected_joint(source, joint, robot)).collect(),
    };
    Ok(sources.iter().map(selected).collect())
}

/// A joint of the robot on a topic of the survey.
fn selected_joint(source: &JointSource, joint: &str, robot: &Robot) -> Option<SelectedJoint> {
    let at = robot.movable_joint_names().position(|name| name == joint)?;
    let JointSource { prefix, suffix, prefix_of_robot, .. } = source;
    let own = joint.strip_prefix(prefix_of_robot.as_str()).unwrap_or(joint);
    Some(SelectedJoint { name: format!("{prefix}{own}{suffix}"), joint: at, si_per_unit: 1.0 })
}

/// A joint that two sources have.
fn twice<'a>(sources: &[&'a JointSource]) -> Option<&'a str> {
    let mut seen = BTreeMap::new();
    let joints =
        sources.iter().flat_map(|source| source.joints.iter().map(|joint| (joint.as_str(), *source)));
    joints.into_iter().find(|(joint, source)| seen.insert(*joint, *source).is_some()).map(|(joint, _)| joint)
}

fn on_two_topics(sources: &[&JointSource], joint: &str) -> Diagnostic {
    let having: Vec<&&JointSource> =
        sources.iter().filter(|source| source.joints.iter().any(|known| known == joint)).collect();
    let names: Vec<String> =
        having.iter().map(|source| format!("{}{}", source.topic, around(source))).collect();
    let message = format!(
        "joint \"{joint}\" is in {}: which of them was measured is not known",
        names.join(" and in ")
    );
    let written: Vec<String> = having.iter().map(|source| written(source, None)).collect();
    let help = format!(
        "`replay` takes --joints TOPIC, and --setpoint TOPIC for commanded ones; a scenario has, with role = \"setpoint\" for those:\n{}",
        written.join("\nor\n")
    );
    Diagnostic::error(codes::scenario::LOGGED_JOINTS, message).with_help(help)
}

/// How the names of a source differ from those of the robot, for a message.
fn around(source: &JointSource) -> String {
    match (source.prefix.as_str(), source.suffix.as_str()) {
        ("", "") => String::new(),
        (prefix, "") => format!(" with the prefix \"{prefix}\""),
        ("", suffix) => format!(" with the suffix \"{suffix}\""),
        (prefix, suffix) => format!(" with the prefix \"{prefix}\" and the suffix \"{suffix}\""),
    }
}

/// The section that takes a source.
fn written(source: &JointSource, position: Option<&str>) -> String {
    let mut text = format!("[[source.joints]]\ntopic = {:?}", source.topic);
    let parts = [
        ("prefix", Some(source.prefix.as_str())),
        ("suffix", Some(source.suffix.as_str())),
        ("position", position),
    ];
    for (key, value) in parts {
        if let Some(value) = value.filter(|value| !value.is_empty()) {
            let _ = write!(text, "\n{key} = {value:?}");
        }
    }
    text
}

fn no_joint(survey: &LogSurvey, robot: &Robot) -> Diagnostic {
    let message = format!("the log has no joint of robot \"{}\"", robot.name());
    let unknown = survey.robot.iter().flat_map(|of| &of.unknown);
    let named: Vec<&str> = unknown.map(|joint| joint.name.as_str()).collect();
    let help = if named.is_empty() {
        let topics: Vec<String> =
            survey.topics.iter().map(|topic| format!("{} ({})", topic.name, topic.message_type)).collect();
        format!("it has {}, and no joint states that can be read", listed(&topics))
    } else {
        let own: Vec<&str> = robot.movable_joint_names().collect();
        format!("it has the joints {}; the robot has {}", listed(&named), listed(&own))
    };
    Diagnostic::error(codes::scenario::LOGGED_JOINTS, message).with_help(help)
}

/// Some names for a message.
fn listed<T: AsRef<str>>(names: &[T]) -> String {
    const MOST: usize = 12;
    let mut text: Vec<&str> = names.iter().take(MOST).map(AsRef::as_ref).collect();
    if names.len() > MOST {
        text.push("...");
    }
    if text.is_empty() { "no topic".to_owned() } else { text.join(", ") }
}

/// The topics that the scenario names.
fn named(
    settings: &SourceSettings,
    place: FilePlace<'_>,
    survey: &LogSurvey,
    robot: &Robot,
) -> Result<Vec<SelectedJoints>, Findings> {
    let mut selected: Vec<SelectedJoints> = Vec::new();
    let mut taken: BTreeMap<(bool, usize), &str> = BTreeMap::new();
    for (at, settings) in settings.joints.iter().enumerate() {
        let place = place.key("joints").item(at);
        let topic = topic_of(&settings.topic, place, survey, TopicContent::Joints)?;
        let of_topic = joints_of(settings, place, topic, robot)?;
        for joint in &of_topic.joints {
            if let Some(before) = taken.insert((of_topic.is_setpoint, joint.joint), &settings.topic) {
                let name = robot.movable_joint_names().nth(joint.joint).unwrap_or_default();
                let message = format!("joint \"{name}\" is taken from {before} and from {}", settings.topic);
                let error = Diagnostic::error(codes::scenario::LOGGED_JOINTS, message);
                let help = "remove one of them, or give it role = \"setpoint\"";
                return Err(place.mark(error.with_help(help)).into());
            }
        }
        selected.push(of_topic);
    }
    Ok(selected)
}

/// The joints of the robot on a topic, by the names that the scenario gives.
fn joints_of(
    settings: &LoggedJointSettings,
    place: FilePlace<'_>,
    topic: &TopicSurvey,
    robot: &Robot,
) -> Result<SelectedJoints, Findings> {
    let own: Vec<&str> = robot.movable_joint_names().collect();
    let logged: Vec<&str> =
        topic.joints.iter().flat_map(|of| of.joints.iter().map(|joint| joint.name.as_str())).collect();
    if let Some(unknown) = settings.names.keys().find(|name| !own.contains(&name.as_str())) {
        let message = format!("the robot has no moving joint \"{unknown}\"");
        let error = Diagnostic::error(codes::scenario::LOGGED_JOINTS, message);
        return Err(place.key("names").mark(error.with_help(known_names(unknown, "joints", own))).into());
    }
    let mut joints = Vec::new();
    for (at, (&index, name)) in robot.movable_joints().iter().zip(&own).enumerate() {
        let stated = settings.names.get(*name);
        let in_log =
            stated.cloned().unwrap_or_else(|| format!("{}{name}{}", settings.prefix, settings.suffix));
        if !logged.contains(&in_log.as_str()) {
            if stated.is_some() {
                let message = format!("{} has no joint \"{in_log}\"", settings.topic);
                let error = Diagnostic::error(codes::scenario::LOGGED_JOINTS, message);
                let help = known_names(&in_log, "joints of the topic", logged);
                return Err(place.key("names").mark(error.with_help(help)).into());
            }
            continue;
        }
        let turns = robot.joint(index).kind != JointKind::Prismatic;
        let is_degree = turns && settings.position == AngleUnit::Deg;
        let si_per_unit = if is_degree { std::f64::consts::PI / 180.0 } else { 1.0 };
        joints.push(SelectedJoint { name: in_log, joint: at, si_per_unit });
    }
    if joints.is_empty() {
        let message = format!("{} has no joint of robot \"{}\" by these names", settings.topic, robot.name());
        let error = Diagnostic::error(codes::scenario::LOGGED_JOINTS, message);
        let help = format!("it has {}; give `prefix`, `suffix` or `names`", listed(&logged));
        return Err(place.key("topic").mark(error.with_help(help)).into());
    }
    let is_setpoint = settings.role == JointRole::Setpoint;
    let effort_is_torque = settings.effort == LoggedEffort::Torque;
    Ok(SelectedJoints {
        topic: settings.topic.clone(),
        is_setpoint,
        maximum_gap_s: 0.0,
        effort_is_torque,
        joints,
    })
}

/// The topic of this name.
///
/// # Errors
/// The log has none with such content.
pub(super) fn topic_of<'s>(
    name: &str,
    place: FilePlace<'_>,
    survey: &'s LogSurvey,
    content: TopicContent,
) -> Result<&'s TopicSurvey, Diagnostic> {
    let is_wanted = |topic: &&TopicSurvey| {
        topic.content == content || content == TopicContent::Pose && topic.content == TopicContent::Transforms
    };
    let known = || survey.topics.iter().filter(is_wanted);
    known().find(|topic| topic.name == name).ok_or_else(|| {
        let what = if content == TopicContent::Joints { "joint states" } else { "poses" };
        let message = format!("the log has no topic \"{name}\" with {what}");
        let names: Vec<&str> = known().map(|topic| topic.name.as_str()).collect();
        let error = Diagnostic::error(codes::scenario::LOGGED_TOPIC, message);
        let help = if names.is_empty() {
            format!("none of its topics has {what} that can be read")
        } else {
            known_names(name, "topics", names)
        };
        place.key("topic").mark(error.with_help(help))
    })
}
