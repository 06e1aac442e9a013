//! Which poses of a log are compared with the robot, and where they come from.

use congruent_description::RobotDescription;
use congruent_input::{Diagnostic, Findings, known_names};
use congruent_logs::{FramePair, LogSurvey, TopicContent, TopicSurvey};
use congruent_scenario::{LoggedPoseSettings, PoseOrigin, PoseSettings};

use super::{
    request::ReplayRequest,
    survey_words::{LEFT_OUT, rate},
};
use crate::codes;

/// Parts of names of topics and frames that a robot's driver publishes: computed by its controller.
const OF_CONTROLLERS: [&str; 4] = ["tcp_pose", "pose_broadcaster", "tool0_controller", "o_t_ee"];
/// Parts of names of what measures poses.
const OF_INSTRUMENTS: [&str; 12] = [
    "tracker",
    "vicon",
    "mocap",
    "optitrack",
    "vrpn",
    "laser",
    "camera",
    "aruco",
    "apriltag",
    "measured",
    "qualisys",
    "leica",
];

/// The poses that the request names, and those whose names say their origin; TF between links of the robot.
///
/// # Errors
/// The request names a topic that the log has not.
pub(super) fn chosen_poses(
    description: &RobotDescription,
    request: &ReplayRequest,
    survey: &LogSurvey,
    taken: &mut Vec<String>,
) -> Result<Vec<LoggedPoseSettings>, Findings> {
    let is_pose =
        |topic: &&TopicSurvey| matches!(topic.content, TopicContent::Pose | TopicContent::Transforms);
    let topics: Vec<&TopicSurvey> =
        survey.topics.iter().filter(is_pose).filter(|topic| topic.messages > 0).collect();
    for (name, _) in &request.poses {
        if !topics.iter().any(|topic| topic.name == *name) {
            let message = format!("the log has no topic \"{name}\" with poses");
            let names: Vec<&str> = topics.iter().map(|topic| topic.name.as_str()).collect();
            let help = if names.is_empty() {
                "none of its topics has poses that can be read: geometry_msgs PoseStamped, PoseWithCovarianceStamped, \
                 TransformStamped, or TF"
                    .to_owned()
            } else {
                known_names(name, "topics", names)
            };
            return Err(Diagnostic::error(codes::replay::POSES, message).with_help(help).into());
        }
    }
    let mut chosen = Vec::new();
    for topic in topics {
        let stated = request.poses.iter().find(|(name, _)| *name == topic.name).map(|(_, origin)| *origin);
        let mut of_topic = Vec::new();
        for pair in &topic.frames {
            match origin(stated, topic, pair, description) {
                Some(origin) => of_topic.push(settings(topic, pair, origin, description)),
                None if topic.encoding == "json" => taken.push(format!(
                    "{LEFT_OUT}poses without an origin: say \"origin\": \"measured\", \"controller\" or \"derived\" in their lines"
                )),
                None if topic.content == TopicContent::Pose => taken.push(format!(
                    "{LEFT_OUT}poses of {}: say where they come from by --measured-pose {0} or --controller-pose {0}",
                    topic.name
                )),
                None => {}
            }
        }
        if let Some(first) = of_topic.first() {
            let frames = if of_topic.len() == 1 { "frame" } else { "frames" };
            let word = congruent_input::serde_name(&first.origin).to_owned();
            taken.push(format!(
                "{word} poses: {} ({} {frames}){}",
                topic.name,
                of_topic.len(),
                rate(survey, &topic.name)
            ));
        }
        chosen.append(&mut of_topic);
    }
    Ok(chosen)
}

/// Takes out poses whose frame is no link of the robot: nothing can be fitted to a stream.
pub(super) fn keep_known_frames(
    description: &RobotDescription,
    poses: &mut Vec<LoggedPoseSettings>,
    taken: &mut Vec<String>,
) {
    poses.retain(|pose| {
        let frame = pose.from_link.as_ref().or(pose.frame.as_ref());
        let is_known = frame.is_some_and(|frame| is_link(description, frame));
        if !is_known {
            let frame = frame.map_or("", String::as_str);
            taken.push(format!(
                "{LEFT_OUT}poses of {}: \"{frame}\" is no link of the robot; a scenario says where it is, by from_link and \
                 link_from_frame under [[source.pose]]",
                pose.topic
            ));
        }
        is_known
    });
}

/// Where the poses of a pair of frames come from, if it is known.
fn origin(
    stated: Option<PoseOrigin>,
    topic: &TopicSurvey,
    pair: &FramePair,
    description: &RobotDescription,
) -> Option<PoseOrigin> {
    let child = pair.child.as_deref().unwrap_or_default().to_lowercase();
    let name = topic.name.to_lowercase();
    let has = |parts: &[&str]| parts.iter().any(|part| name.contains(part) || child.contains(part));
    if stated.is_some() {
        return stated;
    }
    if topic.content == TopicContent::Transforms {
        let is_link = |name: &str| is_link(description, name);
        return match &pair.child {
            Some(_) if child == "tool0_controller" => Some(PoseOrigin::Controller),
            Some(child) if is_link(&pair.frame) && is_link(child) => Some(PoseOrigin::Derived),
            _ => None,
        };
    }
    // So are poses of JSON Lines named, by what their sender says.
    match topic.name.as_str() {
        "derived" => return Some(PoseOrigin::Derived),
        "controller" => return Some(PoseOrigin::Controller),
        "measured" => return Some(PoseOrigin::Measured),
        _ => {}
    }
    if has(&OF_CONTROLLERS) {
        return Some(PoseOrigin::Controller);
    }
    has(&OF_INSTRUMENTS).then_some(PoseOrigin::Measured)
}

fn is_link(description: &RobotDescription, name: &str) -> bool {
    link_of(description, name).is_some()
}

/// The link that a frame is: one of its name, without the namespace before it.
fn link_of<'a>(description: &'a RobotDescription, frame: &str) -> Option<&'a str> {
    let links = || description.robot.links().iter().map(|link| link.name.as_str());
    let last = frame.rsplit('/').next().unwrap_or(frame);
    links().find(|link| *link == frame).or_else(|| links().find(|link| *link == last))
}

/// The link, if a frame has another name.
fn renamed(description: &RobotDescription, frame: &str) -> Option<String> {
    link_of(description, frame).filter(|link| *link != frame).map(str::to_owned)
}

fn settings(
    topic: &TopicSurvey,
    pair: &FramePair,
    origin: PoseOrigin,
    description: &RobotDescription,
) -> LoggedPoseSettings {
    // The flange of a UR as its controller computes it: the link of that name is the same by the URDF.
    let is_flange = pair.child.as_deref() == Some("tool0_controller") && is_link(description, "tool0");
    LoggedPoseSettings {
        topic: topic.name.clone(),
        origin,
        frame: Some(pair.frame.clone()),
        child: pair.child.clone(),
        from_link: renamed(description, &pair.frame),
        link_from_frame: PoseSettings::default(),
        link: if is_flange {
            Some("tool0".to_owned())
        } else {
            pair.child.as_deref().and_then(|child| renamed(description, child))
        },
        link_from_target: None,
        frames_are_fitted: false,
        offset_s: 0.0,
        drift: 0.0,
        position_only: false,
    }
}
