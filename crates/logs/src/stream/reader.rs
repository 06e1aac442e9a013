//! Reads a log from its beginning to its end, and gives the rows and poses that are taken.

use std::{collections::VecDeque, path::Path};

use congruent_input::Diagnostic;

use super::{
    in_order::SPAN_S,
    joint_row::{JointRow, JointRowCounts},
    pose_stream::{PoseCounts, PoseSeries, StreamedPose},
    rows::RowMaker,
    selection::StreamSelection,
};
use crate::{
    event::{EventTime, LogEvent, LogReader, LoggedJoints},
    open::open_log,
    options::LogOptions,
    survey::ClockKind,
};

/// A step back of a clock by more than this is a restart: a clock was set, or a replay began again. Within it messages are put in
/// order.
const RESTART_S: f64 = SPAN_S;
/// Rounding of times, s.
const ROUNDING_S: f64 = 1e-9;
/// Time between the last row before a restart and the first one after it. Kind: choice; longer than any gap across which something
/// is interpolated.
const BETWEEN_PARTS_S: f64 = 1.0;

/// What comes next of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StreamEvent {
    /// All joints at one instant, later than before: see [`LogStream::row`].
    Row,
    /// A pose, which may be earlier or later than the last row.
    Pose(StreamedPose),
}

/// The clock of a topic.
#[derive(Debug, Clone, Copy)]
struct TopicClock {
    /// Of its last message; NaN before the first.
    last_s: f64,
    /// How often it went back.
    part: u64,
}

impl Default for TopicClock {
    fn default() -> Self {
        Self { last_s: f64::NAN, part: 0 }
    }
}

/// The rows and poses of a log. Memory does not grow with the log.
pub struct LogStream {
    reader: Box<dyn LogReader>,
    selection: StreamSelection,
    rows: RowMaker,
    poses: Vec<PoseSeries>,
    /// Poses that are given next: several selections may have the same one, with other offsets.
    ready: VecDeque<StreamedPose>,
    /// Is added to the times of the log.
    shift_s: f64,
    /// Of each topic, by its index.
    clocks: Vec<TopicClock>,
    /// The latest time of a message with joint states.
    latest_s: f64,
    /// When the parts behind the first begin that no row has reached yet.
    parts_s: VecDeque<f64>,
    begins_part: bool,
    has_ended: bool,
}

impl std::fmt::Debug for LogStream {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LogStream").field("latest_s", &self.latest_s).finish_non_exhaustive()
    }
}

impl LogStream {
    /// Opens a log.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn open(path: &Path, options: &LogOptions, selection: StreamSelection) -> Result<Self, Diagnostic> {
        Ok(Self::new(open_log(path, options)?, selection))
    }

    /// The rows and poses of a log that is open.
    pub fn new(reader: Box<dyn LogReader>, selection: StreamSelection) -> Self {
        Self {
            reader,
            rows: RowMaker::new(&selection),
            poses: selection.poses.iter().cloned().map(PoseSeries::new).collect(),
            ready: VecDeque::new(),
            shift_s: -selection.origin_s,
            clocks: Vec::new(),
            latest_s: f64::NEG_INFINITY,
            parts_s: VecDeque::new(),
            begins_part: false,
            has_ended: false,
            selection,
        }
    }

    /// What comes next; `None` after the last.
    ///
    /// # Errors
    /// The rest cannot be read at all.
    pub fn next_event(&mut self) -> Result<Option<StreamEvent>, Diagnostic> {
        let [from_s, until_s] = self.selection.between_s;
        loop {
            if let Some(pose) = self.ready.pop_front() {
                return Ok(Some(StreamEvent::Pose(pose)));
            }
            if self.rows.advance() {
                let row_s = self.rows.row().time_s;
                self.begins_part = self.parts_s.front().is_some_and(|part_s| *part_s <= row_s + ROUNDING_S);
                if self.begins_part {
                    self.parts_s.pop_front();
                }
                if row_s > until_s {
                    self.has_ended = true;
                    return Ok(None);
                }
                if row_s >= from_s {
                    return Ok(Some(StreamEvent::Row));
                }
                continue;
            }
            if self.has_ended {
                return Ok(None);
            }
            if let Some(event) = self.reader.next_event()? {
                self.take(event);
            } else {
                self.rows.flush();
                self.has_ended = true;
            }
        }
    }

    /// Whether that row begins a part behind which a clock went back: its time from the row before means nothing.
    pub fn begins_part(&self) -> bool {
        self.begins_part
    }

    /// The row of the last [`StreamEvent::Row`].
    pub fn row(&self) -> &JointRow {
        self.rows.row()
    }

    fn take(&mut self, event: LogEvent) {
        match event {
            LogEvent::Joints(joints) => self.joints(joints),
            LogEvent::Pose(pose) => {
                let topic = pose.topic;
                let name = &self.reader.topics()[topic].name;
                if !self.poses.iter().any(|stream| stream.is_of(name, &pose)) {
                    return;
                }
                let Some(time_s) = self.time(topic, &pose.time) else { return };
                let name = &self.reader.topics()[topic].name;
                let streams =
                    self.poses.iter_mut().enumerate().filter(|(_, stream)| stream.is_of(name, &pose));
                self.ready.extend(streams.filter_map(|(at, stream)| stream.take(at, time_s, &pose)));
            }
            LogEvent::Unusable(messages) => self.rows.lose(messages),
            LogEvent::Gap(_) => self.rows.counts.unreadable_parts += 1,
            LogEvent::StaticEdge(_) | LogEvent::Description(_) | LogEvent::Other(_) => {}
        }
    }

    fn joints(&mut self, joints: LoggedJoints) {
        let topic = joints.topic;
        let name = &self.reader.topics()[topic].name;
        let Some(first) = self.rows.selection_of(name, 0) else { return };
        let second = self.rows.selection_of(name, first + 1);
        let Some(time_s) = self.time(topic, &joints.time) else { return };
        self.latest_s = self.latest_s.max(time_s);
        // One topic may have measured states and setpoints under other names.
        if let Some(second) = second {
            self.rows.take(second, time_s, joints.clone());
        }
        self.rows.take(first, time_s, joints);
    }

    /// The time of a message, if it belongs to the part of the log that is read now. The first step back of a topic begins a
    /// new part, and messages of the others are of the part before until their clock goes back, too.
    fn time(&mut self, topic: usize, time: &EventTime) -> Option<f64> {
        let part = self.rows.counts.restarts;
        if self.clocks.len() <= topic {
            self.clocks.resize(topic + 1, TopicClock::default());
        }
        let time_s = match self.selection.clock {
            ClockKind::Stamp => time.stamp_s.unwrap_or(time.log_s),
            ClockKind::Log => time.log_s,
        };
        let clock = &mut self.clocks[topic];
        if clock.last_s.is_nan() {
            clock.part = part;
        } else if clock.last_s - time_s > RESTART_S {
            clock.part += 1;
        }
        clock.last_s = time_s;
        if clock.part > part {
            self.rows.counts.restarts += 1;
            let begin_s = self.latest_s
                + BETWEEN_PARTS_S
                + self.selection.joints.iter().map(|topic| topic.maximum_gap_s).fold(0.0, f64::max);
            if begin_s.is_finite() {
                self.shift_s = begin_s - time_s;
                self.parts_s.push_back(begin_s);
            }
        }
        (clock.part >= part).then_some(time_s + self.shift_s)
    }

    /// Instants that were left out since the last row, and messages that could not be used: behind the last one, those that
    /// nobody has seen.
    pub fn left_out_since_row(&self) -> [u64; 2] {
        self.rows.left_out()
    }

    /// What became of the messages with joint states so far.
    pub fn joint_counts(&self) -> JointRowCounts {
        self.rows.counts()
    }

    /// What became of the poses so far, by selection.
    pub fn pose_counts(&self) -> Vec<PoseCounts> {
        self.poses.iter().map(|stream| stream.counts).collect()
    }
}
