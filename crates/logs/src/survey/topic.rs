//! One topic so far.

use congruent_robot::Robot;

use super::{
    clock::{ClockTrack, MessageSum},
    frames::{FramesTrack, pose_sum},
    joints::JointsTrack,
    report::{ClockKind, TopicSurvey, UndecodedMessages},
};
use crate::event::{EventTime, LogTopic, LoggedJoints, LoggedPose, OtherMessage, TopicContent};

/// The messages of a topic so far.
#[derive(Debug, Default)]
pub(super) struct TopicTrack {
    clock: Option<ClockTrack>,
    undecoded: Option<UndecodedMessages>,
    pub(super) joints: Option<JointsTrack>,
    frames: FramesTrack,
}

impl TopicTrack {
    pub(super) fn joints(&mut self, message: &LoggedJoints, robot: Option<&Robot>) {
        let joints = self.joints.get_or_insert_default();
        joints.take(message, robot);
        let sum = joints.sum(message);
        self.time(&message.time, ClockKind::Stamp, Some(sum));
    }

    /// A pose of the topic; an edge of TF has a stamp of its own, which says nothing about the message.
    pub(super) fn pose(&mut self, pose: &LoggedPose, content: TopicContent) {
        self.frames.take(pose);
        let is_pose = content == TopicContent::Pose;
        if pose.is_first_of_message {
            let clock = if is_pose { ClockKind::Stamp } else { ClockKind::Log };
            self.time(&pose.time, clock, is_pose.then(|| pose_sum(pose)));
        }
    }

    pub(super) fn other(&mut self, message: OtherMessage) {
        self.time(&message.time, ClockKind::Log, None);
        if let Some(reason) = message.fault {
            self.undecoded.get_or_insert(UndecodedMessages { count: 0, reason }).count += 1;
        }
    }

    /// Takes the time of a message; those of a topic without stamps are log times.
    pub(super) fn time(&mut self, time: &EventTime, wanted: ClockKind, sum: Option<MessageSum>) {
        self.clock.get_or_insert_with(|| ClockTrack::begin(time, wanted)).take(time, wanted, sum);
    }

    pub(super) fn report(&mut self, topic: &LogTopic, first_ns: i64) -> TopicSurvey {
        let clock = self.clock.take();
        TopicSurvey {
            name: topic.name.clone(),
            message_type: topic.message_type.clone(),
            encoding: topic.encoding.clone(),
            content: topic.content,
            messages: clock.as_ref().map_or(0, ClockTrack::count),
            times: clock.map(|clock| clock.finish(first_ns)),
            undecoded: self.undecoded.take(),
            joints: self.joints.as_ref().map(JointsTrack::report),
            frames: self.frames.report(),
        }
    }
}
