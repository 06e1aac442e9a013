//! The one pass over a log.

use std::{path::Path, sync::Arc};

use congruent_input::{Diagnostic, Finding, Severity, SourceFile};
use congruent_robot::Robot;

use super::{
    description::robot_in_log,
    findings,
    limits::moving_names,
    report::{ClockKind, LogSurvey, TopicSurvey},
    robot,
    topic::TopicTrack,
    utc::date,
};
use crate::{
    descriptions::Descriptions,
    event::{EventTime, LogEvent, LogFormat, LogReader, seconds},
    open::open_log,
    options::LogOptions,
};

/// Most parts that cannot be read of which each is reported.
const MOST_GAPS: u64 = 20;

/// A survey, with what it warns of as messages.
#[derive(Debug, Clone)]
pub struct SurveyedLog {
    /// The survey.
    pub survey: LogSurvey,
    /// The warnings of the survey.
    pub warnings: Vec<Diagnostic>,
}

/// What was seen so far.
#[derive(Default)]
struct Pass {
    topics: Vec<TopicTrack>,
    descriptions: Descriptions,
    log: Option<LogTimes>,
    unreadable_parts: u64,
    warnings: Vec<Diagnostic>,
}

/// Log times of messages: of the first in the file, and the range of all. Recorders write messages of some topics later.
#[derive(Default, Clone, Copy)]
struct LogTimes {
    first_ns: i64,
    range_ns: [i64; 2],
}

/// Reads a log once and says what is in it; with a robot, how its joints and units fit.
///
/// # Errors
/// The log cannot be read, or nothing of it is in an encoding that is read.
pub fn survey_log(
    path: &Path,
    options: &LogOptions,
    robot: Option<&Robot>,
) -> Result<SurveyedLog, Diagnostic> {
    let mut options = options.clone();
    if let Some(robot) = robot.filter(|_| options.joints.is_empty()) {
        options.joints = moving_names(robot);
    }
    let mut reader = open_log(path, &options)?;
    let mut pass = Pass::default();
    while let Some(event) = reader.next_event()? {
        pass.take(event, reader.as_ref(), robot);
    }
    pass.finish(path, reader.as_ref(), robot)
}

/// Says what is in a part of a log that was read already, of a robot.
pub(crate) fn survey_events(
    path: &Path,
    reader: &dyn LogReader,
    events: &[LogEvent],
    robot: &Robot,
) -> Result<SurveyedLog, Diagnostic> {
    let mut pass = Pass::default();
    for event in events {
        pass.take(event.clone(), reader, Some(robot));
    }
    pass.finish(path, reader, Some(robot))
}

impl Pass {
    fn take(&mut self, event: LogEvent, reader: &dyn LogReader, robot: Option<&Robot>) {
        match event {
            LogEvent::Joints(joints) => self.topic(joints.topic, &joints.time).joints(&joints, robot),
            LogEvent::Pose(pose) | LogEvent::StaticEdge(pose) => {
                let content = reader.topics()[pose.topic].content;
                self.topic(pose.topic, &pose.time).pose(&pose, content);
            }
            LogEvent::Description(description) => {
                self.topic(description.topic, &description.time).time(
                    &description.time,
                    ClockKind::Log,
                    None,
                );
                self.descriptions.take(description);
            }
            LogEvent::Other(message) => self.topic(message.topic, &message.time).other(message),
            // What they are is said by a gap, or by who listens.
            LogEvent::Unusable(_) => {}
            LogEvent::Gap(gap) => {
                self.unreadable_parts += 1;
                if self.unreadable_parts <= MOST_GAPS {
                    let between =
                        gap.between_s.map(|[from_s, to_s]| format!(" (from {from_s:.3} s to {to_s:.3} s)"));
                    let mut cause = gap.cause;
                    cause.message += &between.unwrap_or_default();
                    self.warnings.push(cause);
                }
            }
        }
    }

    fn topic(&mut self, topic: usize, time: &EventTime) -> &mut TopicTrack {
        let ns = time.log_ns;
        let log = self.log.get_or_insert(LogTimes { first_ns: ns, range_ns: [ns; 2] });
        log.range_ns = [log.range_ns[0].min(ns), log.range_ns[1].max(ns)];
        if self.topics.len() <= topic {
            self.topics.resize_with(topic + 1, TopicTrack::default);
        }
        &mut self.topics[topic]
    }

    fn finish(
        mut self,
        path: &Path,
        reader: &dyn LogReader,
        robot: Option<&Robot>,
    ) -> Result<SurveyedLog, Diagnostic> {
        let source = Arc::new(SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false });
        let topics = reader.topics();
        // Topics that are declared and have no message.
        self.topics.resize_with(topics.len(), TopicTrack::default);
        let LogTimes { first_ns, range_ns: [earliest_ns, latest_ns] } = self.log.unwrap_or_default();
        let surveyed: Vec<_> =
            self.topics.iter_mut().zip(topics).map(|(track, topic)| track.report(topic, first_ns)).collect();
        let tracks = topics.iter().map(|topic| topic.name.as_str()).zip(&self.topics);
        let joints = tracks.filter_map(|(name, track)| Some((name, track.joints.as_ref()?)));
        let robot = robot.map(|robot| robot::compare(robot, joints));
        let mut found: Vec<Diagnostic> = findings::nothing_read(&surveyed).into_iter().collect();
        if let Some(refused) = found.pop_if(|finding| finding.severity == Severity::Error) {
            return Err(refused.in_file(&source));
        }
        found.extend(reader.warnings().iter().cloned());
        found.extend(findings::of_topics(&surveyed, reader.format()));
        found.extend(robot.iter().flat_map(findings::of_robot));
        self.warnings.extend(found.into_iter().map(|finding| finding.in_file(&source)));
        let format = reader.format();
        let survey = LogSurvey {
            file: path.display().to_string(),
            format,
            begun: date(earliest_ns),
            duration_s: seconds(latest_ns.saturating_sub(earliest_ns)),
            messages: messages(&surveyed, format),
            topics: surveyed,
            table: reader.table().cloned(),
            description: robot_in_log(&self.descriptions, topics),
            robot,
            unreadable_parts: self.unreadable_parts,
            warnings: self.warnings.iter().map(Finding::from).collect(),
        };
        Ok(SurveyedLog { survey, warnings: self.warnings })
    }
}

fn messages(topics: &[TopicSurvey], format: LogFormat) -> u64 {
    let counts = topics.iter().map(|topic| topic.messages);
    match format {
        LogFormat::Mcap | LogFormat::Db3 | LogFormat::JsonLines | LogFormat::Rtde => counts.sum(),
        // Rows of a UR are joints and a pose.
        LogFormat::Table | LogFormat::Parquet | LogFormat::LeRobot => counts.max().unwrap_or_default(),
    }
}

#[cfg(test)]
#[path = "pass_tests.rs"]
mod tests;
