//! Which poses of a log are compared with the model, and between which frames of the robot.

use congruent_description::{LinkIndex, RobotDescription};
use congruent_input::{Diagnostic, Findings, known_names};
use congruent_logs::{FramePair, LogSurvey, SelectedPoses, TopicContent, TopicSurvey};
use congruent_monitors::ComparedPoses;
use congruent_scenario::{FilePlace, LoggedPoseSettings, SourceSettings};
use nalgebra::Isometry3;

use super::joints::topic_of;
use crate::codes;

/// The poses that a scenario names, with their frames in the robot.
///
/// # Errors
/// What a scenario names is not there, or it does not say which frame of the robot a frame of the log is.
pub(super) fn poses(
    settings: &SourceSettings,
    place: FilePlace<'_>,
    survey: &LogSurvey,
    description: &RobotDescription,
) -> Result<Vec<(SelectedPoses, ComparedPoses)>, Findings> {
    let pose = |(at, settings): (usize, &LoggedPoseSettings)| {
        let place = place.key("pose").item(at);
        let topic = topic_of(&settings.topic, place, survey, TopicContent::Pose)?;
        let pair = frames(settings, place, topic)?;
        compared(settings, place, pair, description)
    };
    settings.pose.iter().enumerate().map(pose).collect::<Result<_, Diagnostic>>().map_err(Findings::from)
}

/// The frame and the child of the messages.
fn frames(
    settings: &LoggedPoseSettings,
    place: FilePlace<'_>,
    topic: &TopicSurvey,
) -> Result<FramePair, Diagnostic> {
    let fits = |pair: &&FramePair| {
        let is_frame = settings.frame.as_ref().is_none_or(|frame| *frame == pair.frame);
        is_frame && (settings.child.is_none() || settings.child == pair.child)
    };
    let found: Vec<&FramePair> = topic.frames.iter().filter(fits).collect();
    let words = |pair: &FramePair| match &pair.child {
        Some(child) => format!("frame = {:?}, child = {child:?}", pair.frame),
        None => format!("frame = {:?}", pair.frame),
    };
    let all: Vec<String> = topic.frames.iter().map(words).collect();
    let refused = |message: String| {
        let error = Diagnostic::error(codes::scenario::LOGGED_FRAMES, message);
        Err(place.mark(error.with_help(format!("the topic has {}", all.join("; ")))))
    };
    match found.as_slice() {
        [] => refused(format!("{} has no poses of these frames", settings.topic)),
        [one] => Ok((*one).clone()),
        _ => refused(format!("{} has poses of several frames: give `frame` and `child`", settings.topic)),
    }
}

fn compared(
    settings: &LoggedPoseSettings,
    place: FilePlace<'_>,
    pair: FramePair,
    description: &RobotDescription,
) -> Result<(SelectedPoses, ComparedPoses), Diagnostic> {
    let frames = RobotFrames { place, description };
    let from_link = match &settings.from_link {
        Some(name) => frames.stated("from_link", name)?,
        None => frames.find(&pair.frame).ok_or_else(|| unknown_frame(place, &pair.frame))?,
    };
    let (link, link_from_target) = frames.target(settings, &pair)?;
    let name = match &pair.child {
        Some(child) => format!("{} {} -> {child}", settings.topic, pair.frame),
        None => settings.topic.clone(),
    };
    let compared = ComparedPoses {
        name,
        topic: settings.topic.clone(),
        origin: settings.origin,
        from_link,
        link_from_frame: settings.link_from_frame.isometry(place.key("link_from_frame"))?,
        link,
        link_from_target,
        frames_are_fitted: settings.frames_are_fitted,
        position_only: settings.position_only,
        offset_s: settings.offset_s,
    };
    let selected = SelectedPoses {
        topic: settings.topic.clone(),
        frame: pair.frame,
        child: pair.child,
        offset_s: settings.offset_s,
        drift: settings.drift,
    };
    Ok((selected, compared))
}

/// The frames of a robot, for the poses at a place in the scenario.
struct RobotFrames<'a> {
    place: FilePlace<'a>,
    description: &'a RobotDescription,
}

impl RobotFrames<'_> {
    /// The link of a frame's name.
    fn find(&self, frame: &str) -> Option<LinkIndex> {
        let (robot, bare) = (&self.description.robot, frame.trim_start_matches('/'));
        robot.link_indices().find(|&link| robot.link(link).name == bare)
    }

    /// The link that the scenario names under a key.
    fn stated(&self, key: &'static str, name: &str) -> Result<LinkIndex, Diagnostic> {
        self.find(name).ok_or_else(|| {
            let message = format!("the robot has no link \"{name}\"");
            let links = self.description.robot.links().iter();
            let names: Vec<&str> = links.map(|link| link.name.as_str()).collect();
            let error = Diagnostic::error(codes::scenario::UNKNOWN_LINK, message);
            self.place.key(key).mark(error.with_help(known_names(name, "links", names)))
        })
    }

    /// The link that carries the target, and the target in it: what is stated, or the link of the child's name, or the TCP.
    fn target(
        &self,
        settings: &LoggedPoseSettings,
        pair: &FramePair,
    ) -> Result<(LinkIndex, Isometry3<f64>), Diagnostic> {
        let place = self.place.key("link_from_target");
        let own = settings.link_from_target.as_ref().map(|pose| pose.isometry(place)).transpose()?;
        let child = pair.child.as_deref().and_then(|child| self.find(child));
        match (&settings.link, child) {
            (Some(name), _) => Ok((self.stated("link", name)?, own.unwrap_or_else(Isometry3::identity))),
            (None, Some(link)) => Ok((link, own.unwrap_or_else(Isometry3::identity))),
            (None, None) => {
                let tcp = self.description.tip_from_tcp.unwrap_or_else(Isometry3::identity);
                Ok((self.description.tip, own.unwrap_or(tcp)))
            }
        }
    }
}

fn unknown_frame(place: FilePlace<'_>, frame: &str) -> Diagnostic {
    let message = format!("the poses are in frame \"{frame}\", which is no link of the robot");
    place.mark(Diagnostic::error(codes::scenario::LOGGED_FRAMES, message).with_help(
        "give `from_link`, and `link_from_frame` if the frame is not that of the link; `congruent replay` fits it to the log",
    ))
}
