//! Puts the messages of a topic in the order of their times.

use std::{
    cmp::Ordering,
    collections::{BinaryHeap, VecDeque},
};

/// Messages within which times are put in order. Kind: choice; the arrival over a network is mixed up within some ms.
const WINDOW: usize = 64;
/// Time within which they are, s: the messages of a slow topic are not held back for long. Kind: choice, likewise.
pub(super) const SPAN_S: f64 = 0.25;

/// Messages at one time behind the first that are taken for those of a coarse clock. Kind: choice; a clock that counts 10 ms
/// repeats each time nine times at 1 kHz. A clock that repeats more does not advance, and nobody knows when its messages were true.
const MOST_REPEATED: u64 = 10;

/// A message at a time.
#[derive(Debug)]
struct Timed<P, T> {
    time_s: f64,
    part: P,
    /// Number of the message: of two at one time the first stays first.
    number: u64,
    value: T,
}

impl<P, T> PartialEq for Timed<P, T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<P, T> Eq for Timed<P, T> {}

impl<P, T> PartialOrd for Timed<P, T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P, T> Ord for Timed<P, T> {
    fn cmp(&self, other: &Self) -> Ordering {
        // The earliest is the greatest, since a heap gives its greatest.
        other.time_s.total_cmp(&self.time_s).then(other.number.cmp(&self.number))
    }
}

/// Messages of one topic, of which the earliest are given once enough later ones have come. Each has a part of what there is at its time,
/// such as some of the joints.
#[derive(Debug)]
pub(super) struct InOrder<P, T> {
    heap: BinaryHeap<Timed<P, T>>,
    ready: VecDeque<(f64, T)>,
    number: u64,
    newest_s: f64,
    given_s: f64,
    /// The parts that were given at that time.
    given: Vec<P>,
    /// Messages that are held back at most.
    window: usize,
    /// Messages with a part that another message at their time has, and messages that came after a later one was given.
    pub(super) repeated: u64,
    pub(super) late: u64,
    /// Messages among these that nobody can judge, since they were taken last: those that were late, and those at a
    /// time that does not advance.
    pub(super) lost: u64,
    /// Messages that repeat the time that was given last.
    repeated_now: u64,
}

impl<P: PartialEq, T> Default for InOrder<P, T> {
    fn default() -> Self {
        Self {
            heap: BinaryHeap::with_capacity(WINDOW + 1),
            ready: VecDeque::new(),
            number: 0,
            newest_s: f64::NEG_INFINITY,
            given_s: f64::NEG_INFINITY,
            given: Vec::new(),
            window: WINDOW,
            repeated: 0,
            late: 0,
            lost: 0,
            repeated_now: 0,
        }
    }
}

impl<P: PartialEq, T> InOrder<P, T> {
    /// Gives each message at once: one that is earlier than one before it is late.
    pub(super) fn at_once() -> Self {
        Self { window: 0, ..Self::default() }
    }

    pub(super) fn push(&mut self, time_s: f64, part: P, value: T) {
        self.number += 1;
        self.newest_s = self.newest_s.max(time_s);
        self.heap.push(Timed { time_s, part, number: self.number, value });
        while self.heap.len() > self.window || self.span_s() > SPAN_S {
            self.give_first();
        }
    }

    /// No message follows that belongs to these: gives all of them.
    pub(super) fn flush(&mut self) {
        while !self.heap.is_empty() {
            self.give_first();
        }
    }

    /// The latest time that was seen.
    pub(super) fn newest_s(&self) -> f64 {
        self.newest_s
    }

    /// Time between the earliest and the latest message.
    fn span_s(&self) -> f64 {
        self.heap.peek().map_or(0.0, |first| self.newest_s - first.time_s)
    }

    fn give_first(&mut self) {
        let Some(Timed { time_s, part, value, .. }) = self.heap.pop() else { return };
        match time_s.total_cmp(&self.given_s) {
            Ordering::Less => {
                self.late += 1;
                self.lost += 1;
                return;
            }
            Ordering::Equal if self.given.contains(&part) => {
                self.repeated += 1;
                self.repeated_now += 1;
                self.lost += match self.repeated_now.checked_sub(MOST_REPEATED) {
                    None | Some(0) => 0,
                    // The clock has not advanced for any of them.
                    Some(1) => self.repeated_now,
                    Some(_) => 1,
                };
                return;
            }
            Ordering::Equal => {}
            Ordering::Greater => {
                self.given_s = time_s;
                self.given.clear();
                self.repeated_now = 0;
            }
        }
        self.given.push(part);
        self.ready.push_back((time_s, value));
    }

    /// The next message: later than all before it, or another part of the same time.
    pub(super) fn pop(&mut self) -> Option<(f64, T)> {
        self.ready.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_given_in_order_once_each() {
        let mut order = InOrder::default();
        let times: Vec<i32> = (0..200).map(|at| at + if at % 7 == 0 { 5 } else { 0 }).collect();
        for (number, &time) in times.iter().enumerate() {
            order.push(f64::from(time) * 1e-3, (), number);
        }
        order.flush();
        let given: Vec<(f64, usize)> = std::iter::from_fn(|| order.pop()).collect();
        assert!(given.windows(2).all(|pair| pair[0].0 < pair[1].0));
        // Of the two messages at a time, the first counts: 5 is that of number 0.
        assert_eq!(given[4], (5.0 * 1e-3, 0));
        assert_eq!(order.repeated, (times.len() - given.len()) as u64);
        assert_eq!(order.late, 0);
    }

    #[test]
    fn a_stream_has_its_messages_at_once() {
        let mut order = InOrder::at_once();
        let mut given = |time_s: f64| {
            order.push(time_s, (), ());
            order.pop().is_some()
        };
        assert!(given(1.0) && given(1.001) && !given(1.0) && given(1.002));
        assert_eq!((order.late, order.lost), (1, 1));
    }

    #[test]
    fn a_coarse_clock_loses_nothing_and_one_that_stopped_all_of_its_messages() {
        let lost = |repeated: u64| {
            let mut order = InOrder::at_once();
            (0..=repeated).for_each(|at| order.push(1.0, (), at));
            order.push(2.0, (), 0);
            assert_eq!(order.repeated, repeated);
            order.lost
        };
        assert_eq!(
            [0, 9, MOST_REPEATED, MOST_REPEATED + 1, 500].map(lost),
            [0, 0, 0, MOST_REPEATED + 1, 500]
        );
    }

    #[test]
    fn a_message_that_comes_too_late_is_counted() {
        let mut order = InOrder::default();
        (0..100).for_each(|at| order.push(f64::from(at) * 1e-3, (), at));
        order.push(3.5e-3, (), 100);
        order.flush();
        assert_eq!((std::iter::from_fn(|| order.pop()).count(), order.late), (100, 1));
    }
}
