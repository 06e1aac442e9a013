//! The times of the messages of one topic: order, repetitions, gaps.

use std::{
    cmp::Reverse,
    collections::{BinaryHeap, VecDeque},
};

use super::{
    report::{ClockKind, TopicTimes},
    spacing::{Spaced, Spacing},
};
use crate::event::{EventTime, float, seconds};

/// Messages within which stamps are put in order, and among which one that repeats another is found. Kind: choice; the arrival
/// over a network is mixed up within some ms.
const WINDOW: usize = 64;
/// A step back by more than this begins a new part: a clock was set, or a replay began again, ns.
const RESTART_NS: i64 = 1_000_000_000;

/// What a message has, as sums by which repetitions are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MessageSum {
    /// Of what it is about: names of joints, frames.
    pub(super) about: u64,
    /// Of its values.
    pub(super) values: u64,
}

/// A message that was seen lately.
#[derive(Debug, Clone, Copy)]
struct Seen {
    ns: i64,
    sum: MessageSum,
}

/// The times of a topic so far.
#[derive(Debug)]
pub(super) struct ClockTrack {
    clock: ClockKind,
    count: u64,
    without_stamp: u64,
    earliest_ns: i64,
    latest_ns: i64,
    before_ns: i64,
    /// Times that are not in order yet, the smallest first.
    window: BinaryHeap<Reverse<i64>>,
    recent: VecDeque<Seen>,
    spacing: Spacing,
    repeated_messages: u64,
    repeated_stamps: u64,
    steps_back: u64,
    largest_step_back_ns: i64,
    restarts: u64,
    delays: u64,
    delay_sum_s: f64,
}

impl ClockTrack {
    /// A topic with this first message: by stamps from the first of them on, unless log times are wanted.
    pub(super) fn begin(first: &EventTime, wanted: ClockKind) -> Self {
        let stamp_ns = first.stamp_ns.filter(|_| wanted == ClockKind::Stamp);
        let ns = stamp_ns.unwrap_or(first.log_ns);
        Self {
            clock: if stamp_ns.is_some() { ClockKind::Stamp } else { ClockKind::Log },
            count: 0,
            without_stamp: 0,
            earliest_ns: ns,
            latest_ns: ns,
            before_ns: ns,
            window: BinaryHeap::new(),
            recent: VecDeque::new(),
            spacing: Spacing::default(),
            repeated_messages: 0,
            repeated_stamps: 0,
            steps_back: 0,
            largest_step_back_ns: 0,
            restarts: 0,
            delays: 0,
            delay_sum_s: 0.0,
        }
    }

    /// Takes a message; without a sum it is not compared with others.
    pub(super) fn take(&mut self, time: &EventTime, wanted: ClockKind, sum: Option<MessageSum>) {
        let stamp_ns = time.stamp_ns.filter(|_| wanted == ClockKind::Stamp);
        if self.clock == ClockKind::Log && stamp_ns.is_some() {
            // The first stamp of the topic: log times cannot be put in one order with stamps.
            let count = self.count;
            *self = Self { count, without_stamp: count, ..Self::begin(time, wanted) };
        }
        self.count += 1;
        let ns = match (self.clock, stamp_ns) {
            (ClockKind::Log, _) => time.log_ns,
            (ClockKind::Stamp, Some(stamp_ns)) => stamp_ns,
            (ClockKind::Stamp, None) => {
                self.without_stamp += 1;
                return;
            }
        };
        if self.clock == ClockKind::Stamp {
            self.delays += 1;
            self.delay_sum_s += seconds(time.log_ns.saturating_sub(ns));
        }
        let back = self.before_ns.saturating_sub(ns);
        if back > 0 {
            self.steps_back += 1;
            self.largest_step_back_ns = self.largest_step_back_ns.max(back);
        }
        // From the time before, not from the latest: after a clock was set once, it goes on.
        if back > RESTART_NS {
            self.restarts += 1;
            self.drain_to(0);
            self.spacing.begin_part();
            self.recent.clear();
        }
        self.before_ns = ns;
        (self.earliest_ns, self.latest_ns) = (self.earliest_ns.min(ns), self.latest_ns.max(ns));
        if let Some(sum) = sum {
            self.compare(Seen { ns, sum });
        }
        self.window.push(Reverse(ns));
        self.drain_to(WINDOW);
    }

    /// Hands over times in order until so many are kept.
    fn drain_to(&mut self, kept: usize) {
        while self.window.len() > kept {
            if let Some(Reverse(ns)) = self.window.pop() {
                self.spacing.take(ns);
            }
        }
    }

    fn compare(&mut self, seen: Seen) {
        let same_stamp = |of: &&Seen| of.ns == seen.ns && of.sum.about == seen.sum.about;
        let mut same = self.recent.iter().filter(same_stamp).peekable();
        if same.peek().is_some() {
            if same.any(|of| of.sum.values == seen.sum.values) {
                self.repeated_messages += 1;
            } else {
                self.repeated_stamps += 1;
            }
        }
        if self.recent.len() == WINDOW {
            self.recent.pop_front();
        }
        self.recent.push_back(seen);
    }

    /// Number of messages.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// What was found; times are counted from `first_ns` on.
    pub(super) fn finish(mut self, first_ns: i64) -> TopicTimes {
        self.drain_to(0);
        let since = |ns: i64| seconds(ns.saturating_sub(first_ns));
        let Spaced { rate_hz, period_s, gaps } = self.spacing.finish(first_ns);
        TopicTimes {
            clock: self.clock,
            from_s: since(self.earliest_ns),
            to_s: since(self.latest_ns),
            without_stamp: self.without_stamp,
            rate_hz,
            period_s,
            gaps,
            repeated_messages: self.repeated_messages,
            repeated_stamps: self.repeated_stamps,
            steps_back: self.steps_back,
            largest_step_back_s: seconds(self.largest_step_back_ns),
            restarts: self.restarts,
            mean_delay_s: (self.delays > 0).then(|| self.delay_sum_s / float(self.delays)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(stamps: &[i64]) -> TopicTimes {
        times_of(&stamps.iter().map(|ns| EventTime::new(ns + 2_000_000, Some(*ns), 0)).collect::<Vec<_>>())
    }

    fn times_of(times: &[EventTime]) -> TopicTimes {
        let mut track = ClockTrack::begin(&times[0], ClockKind::Stamp);
        let sum = |at: usize| MessageSum { about: 0, values: at as u64 / 2 };
        times.iter().enumerate().for_each(|(at, time)| track.take(time, ClockKind::Stamp, Some(sum(at))));
        track.finish(0)
    }

    #[test]
    fn messages_without_a_stamp_are_counted_and_not_ordered_with_stamps() {
        // Stamps since the start of a simulation, log times since 1970.
        let time = |at: i64, stamp: Option<i64>| EventTime::new(1_760_000_000_000_000_000 + at, stamp, 0);
        for bare in [0, 50] {
            let stamp = |at: i64| (at != bare).then_some(at * 10_000_000);
            let found = times_of(&(0..100).map(|at| time(at, stamp(at))).collect::<Vec<_>>());
            assert_eq!((found.clock, found.without_stamp), (ClockKind::Stamp, 1));
            assert_eq!((found.gaps, found.restarts, found.steps_back), (None, 0, 0));
            assert_eq!((found.from_s, found.to_s), (if bare == 0 { 0.01 } else { 0.0 }, 0.99));
        }
        let found = times_of(&(0..100).map(|at| time(at, None)).collect::<Vec<_>>());
        assert_eq!((found.clock, found.without_stamp), (ClockKind::Log, 0));
    }

    #[test]
    fn stamps_that_are_mixed_up_are_no_gap() {
        let mut stamps: Vec<i64> = (0..1000).map(|at| at * 1_000_000).collect();
        (0..990).step_by(10).for_each(|at| stamps.swap(at, at + 7));
        let found = times(&stamps);
        assert_eq!((found.gaps, found.period_s, found.restarts), (None, Some(0.001), 0));
        assert_eq!((found.steps_back, found.largest_step_back_s), (198, 0.006));
        assert!((found.rate_hz.unwrap() - 1000.0).abs() < 1e-9);
        assert!((found.mean_delay_s.unwrap() - 0.002).abs() < 1e-12);
    }

    #[test]
    fn repeated_messages_and_repeated_stamps() {
        // The values of 0 and 1 are the same, and those of 2 and 3.
        let found = times(&[5, 5, 9, 10, 9]);
        assert_eq!((found.repeated_messages, found.repeated_stamps), (1, 1));
    }

    #[test]
    fn a_clock_that_is_set_back_begins_a_new_part() {
        let stamps: Vec<i64> = (0..200).chain(0..200).map(|at| at * 10_000_000).collect();
        let found = times(&stamps);
        assert_eq!((found.restarts, found.steps_back, found.gaps), (1, 1, None));
        assert_eq!((found.repeated_messages, found.repeated_stamps), (0, 0));
        assert!((found.rate_hz.unwrap() - 100.0).abs() < 1e-9);
    }
}
