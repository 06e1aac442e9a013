//! Joins the joint states of several topics, and of messages that lack some joints, to rows of all joints.

use std::{collections::VecDeque, sync::Arc};

use super::{
    in_order::{InOrder, SPAN_S},
    joint_row::{JointRow, JointRowCounts},
    joint_series::{JointTrace, SeriesPoint},
    selection::{SelectedJoint, SelectedJoints, StreamSelection},
};
use crate::event::{EventTime, LoggedJoints};

/// How long a topic may be silent before rows no longer wait for it, s. Kind: choice; recorders write topics that are this far
/// apart in one order.
const WAITS_S: f64 = 2.0;

/// A topic with joints that are taken.
#[derive(Debug)]
struct Topic {
    selected: SelectedJoints,
    /// By the names of their joints: a driver may publish some of them in one message, and the others in another of the same time.
    messages: InOrder<Arc<[String]>, LoggedJoints>,
    /// The list of names of the last message, and where the joints that are taken are in it.
    names: Option<Arc<[String]>>,
    places: Vec<Option<usize>>,
    reached_s: f64,
}

impl Topic {
    /// Where the joints are in a message.
    fn find_places(&mut self, names: &Arc<[String]>) {
        if self.names.as_ref().is_some_and(|known| Arc::ptr_eq(known, names)) {
            return;
        }
        let place = |joint: &SelectedJoint| names.iter().position(|name| *name == joint.name);
        self.places = self.selected.joints.iter().map(place).collect();
        self.names = Some(Arc::clone(names));
    }
}

/// Rows in the making.
#[derive(Debug)]
pub(super) struct RowMaker {
    topics: Vec<Topic>,
    measured: Vec<JointTrace>,
    setpoints: Vec<JointTrace>,
    /// Whether a topic has the joint: rows wait for it.
    is_measured: Vec<bool>,
    /// For each joint the longest time across which it is interpolated, as measured and as commanded.
    gaps_s: [Vec<f64>; 2],
    /// Times of rows that are not given yet.
    pending: VecDeque<(f64, EventTime)>,
    has_ended: bool,
    row: JointRow,
    /// Instants that were left out since the last row.
    left_out: u64,
    /// Messages that could not be used since the last row.
    unusable: u64,
    pub(super) counts: JointRowCounts,
}

impl RowMaker {
    pub(super) fn new(selection: &StreamSelection) -> Self {
        let joints = selection.joints_of_row;
        let series = || (0..joints).map(|_| JointTrace::default()).collect();
        let mut is_measured = vec![false; joints];
        let measured = selection.joints.iter().filter(|topic| !topic.is_setpoint);
        measured.flat_map(|topic| &topic.joints).for_each(|joint| is_measured[joint.joint] = true);
        let mut gaps_s = [vec![0.0; joints], vec![0.0; joints]];
        for topic in &selection.joints {
            let gaps_s = &mut gaps_s[usize::from(topic.is_setpoint)];
            topic.joints.iter().for_each(|joint| gaps_s[joint.joint] = topic.maximum_gap_s);
        }
        let topic = |selected: &SelectedJoints| Topic {
            selected: selected.clone(),
            messages: if selection.is_live { InOrder::at_once() } else { InOrder::default() },
            names: None,
            places: Vec::new(),
            reached_s: f64::NEG_INFINITY,
        };
        Self {
            topics: selection.joints.iter().map(topic).collect(),
            measured: series(),
            setpoints: series(),
            is_measured,
            gaps_s,
            pending: VecDeque::new(),
            has_ended: false,
            row: JointRow::new(joints),
            left_out: 0,
            unusable: 0,
            counts: JointRowCounts::default(),
        }
    }

    /// The number of the first selection of a topic from `from` on.
    pub(super) fn selection_of(&self, topic: &str, from: usize) -> Option<usize> {
        (from..self.topics.len()).find(|&at| self.topics[at].selected.topic == topic)
    }

    /// Takes a message of a selection.
    pub(super) fn take(&mut self, selection: usize, time_s: f64, message: LoggedJoints) {
        if message.has_wrong_length() {
            self.counts.wrong_lengths += 1;
            self.lose_of(selection, 1);
            return;
        }
        if message.names.is_empty() {
            self.counts.without_positions += 1;
            self.lose_of(selection, 1);
            return;
        }
        self.topics[selection].messages.push(time_s, Arc::clone(&message.names), message);
        self.sort(selection);
    }

    /// Counts messages that cannot be used.
    pub(super) fn lose(&mut self, messages: u64) {
        self.unusable += messages;
    }

    /// Likewise of a selection: rows have the times of the first one, and the joints of the others are known between messages.
    fn lose_of(&mut self, selection: usize, messages: u64) {
        self.unusable += if selection == 0 { messages } else { 0 };
    }

    /// No message follows.
    pub(super) fn flush(&mut self) {
        for selection in 0..self.topics.len() {
            self.topics[selection].messages.flush();
            self.sort(selection);
        }
        self.has_ended = true;
    }

    /// From messages that are in order to the series of their joints.
    fn sort(&mut self, selection: usize) {
        let lost = std::mem::take(&mut self.topics[selection].messages.lost);
        self.lose_of(selection, lost);
        while let Some((time_s, message)) = self.topics[selection].messages.pop() {
            let topic = &mut self.topics[selection];
            topic.find_places(&message.names);
            topic.reached_s = time_s;
            let is_setpoint = topic.selected.is_setpoint;
            let series = if is_setpoint { &mut self.setpoints } else { &mut self.measured };
            let mut has_position = false;
            for (joint, place) in topic.selected.joints.iter().zip(&topic.places) {
                let Some(state) = place.and_then(|place| state(&message, place, joint.si_per_unit)) else {
                    continue;
                };
                has_position = true;
                series[joint.joint].push(time_s, state);
            }
            #[expect(clippy::float_cmp, reason = "times of messages of one instant are equal")]
            let is_same = self.pending.back().is_some_and(|(pending_s, _)| *pending_s == time_s);
            if selection == 0 && !is_same {
                self.pending.push_back((time_s, message.time));
            }
            self.counts.without_positions += u64::from(!has_position);
        }
    }

    /// Instants that were left out since the last row, and messages that could not be used.
    pub(super) fn left_out(&self) -> [u64; 2] {
        [self.left_out, self.unusable]
    }

    /// Makes the next row, if all joints are known by now or cannot be any more; returns whether there is one.
    pub(super) fn advance(&mut self) -> bool {
        self.give_what_waits();
        while let Some(&(time_s, message)) = self.pending.front() {
            if !self.is_decided(time_s) {
                return false;
            }
            self.pending.pop_front();
            if self.fill(time_s) {
                self.row.message = message;
                self.row.left_out = std::mem::take(&mut self.left_out);
                self.row.unusable = std::mem::take(&mut self.unusable);
                self.counts.rows += 1;
                return true;
            }
            self.counts.incomplete += 1;
            self.left_out += 1;
        }
        false
    }

    /// Gives the last messages of topics that have become silent: no later one will come between them.
    fn give_what_waits(&mut self) {
        let Some(first_s) = self.topics.first().map(|topic| topic.reached_s) else { return };
        for selection in 0..self.topics.len() {
            if first_s - self.topics[selection].messages.newest_s() > 2.0 * SPAN_S {
                self.topics[selection].messages.flush();
                self.sort(selection);
            }
        }
    }

    /// The row that was made last.
    pub(super) fn row(&self) -> &JointRow {
        &self.row
    }

    fn is_decided(&self, time_s: f64) -> bool {
        let first_s = self.topics.first().map_or(time_s, |topic| topic.reached_s);
        if self.has_ended || first_s - time_s > WAITS_S {
            return true;
        }
        self.topics.iter().all(|topic| {
            let series = if topic.selected.is_setpoint { &self.setpoints } else { &self.measured };
            // A joint that messages lack is known once one has it again, or not at all beyond the gap.
            topic.reached_s - time_s > topic.selected.maximum_gap_s
                || topic.selected.joints.iter().all(|joint| series[joint.joint].reaches(time_s))
        })
    }

    /// Fills the row; returns whether every joint of a topic is known.
    fn fill(&mut self, time_s: f64) -> bool {
        self.row.time_s = time_s;
        let mut is_whole = true;
        for (joint, series) in self.measured.iter_mut().enumerate() {
            let state = series.at(time_s, self.gaps_s[0][joint]);
            is_whole &= state.is_some() || !self.is_measured[joint];
            let SeriesPoint { q, qd, effort } = state.unwrap_or(UNKNOWN);
            (self.row.q[joint], self.row.qd[joint], self.row.effort[joint]) = (q, qd, effort);
        }
        for (joint, series) in self.setpoints.iter_mut().enumerate() {
            let SeriesPoint { q, qd, .. } = series.at(time_s, self.gaps_s[1][joint]).unwrap_or(UNKNOWN);
            (self.row.setpoint_q[joint], self.row.setpoint_qd[joint]) = (q, qd);
        }
        is_whole
    }

    /// What became of the messages.
    pub(super) fn counts(&self) -> JointRowCounts {
        let sum = |of: fn(&InOrder<Arc<[String]>, LoggedJoints>) -> u64| {
            self.topics.iter().map(|topic| of(&topic.messages)).sum()
        };
        JointRowCounts { repeated: sum(|of| of.repeated), late: sum(|of| of.late), ..self.counts }
    }
}

/// The state of a joint of which nothing is known.
const UNKNOWN: SeriesPoint = SeriesPoint { q: f64::NAN, qd: f64::NAN, effort: f64::NAN };

/// The state of the joint at this place of a message; `None` without a position.
fn state(message: &LoggedJoints, place: usize, si_per_unit: f64) -> Option<SeriesPoint> {
    let value = |array: &[f64]| array.get(place).copied().filter(|value| value.is_finite());
    Some(SeriesPoint {
        q: value(&message.position)? * si_per_unit,
        qd: value(&message.velocity).map_or(f64::NAN, |qd| qd * si_per_unit),
        effort: value(&message.effort).unwrap_or(f64::NAN),
    })
}

#[cfg(test)]
#[path = "rows_tests.rs"]
mod tests;
