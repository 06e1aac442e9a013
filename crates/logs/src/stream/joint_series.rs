//! The states of one joint over time, as far as they are still needed.

use std::collections::VecDeque;

/// The state of a joint at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SeriesPoint {
    pub(super) q: f64,
    /// NaN if it is not known; likewise the effort.
    pub(super) qd: f64,
    pub(super) effort: f64,
}

impl SeriesPoint {
    fn between(&self, other: &Self, share: f64) -> Self {
        let mean = |a: f64, b: f64| a + share * (b - a);
        Self {
            q: mean(self.q, other.q),
            qd: mean(self.qd, other.qd),
            effort: mean(self.effort, other.effort),
        }
    }
}

/// States of a joint in the order of their times.
#[derive(Debug, Default)]
pub(super) struct JointTrace {
    points: VecDeque<(f64, SeriesPoint)>,
}

impl JointTrace {
    pub(super) fn push(&mut self, time_s: f64, state: SeriesPoint) {
        // Of two states at one time the first counts.
        if self.points.back().is_none_or(|(last_s, _)| *last_s < time_s) {
            self.points.push_back((time_s, state));
        }
    }

    /// Whether there is a state at or after a time.
    pub(super) fn reaches(&self, time_s: f64) -> bool {
        self.points.back().is_some_and(|&(last_s, _)| last_s >= time_s)
    }

    /// The state at a time, that of a message or between two that are at most `maximum_gap_s` apart. Forgets what is before it:
    /// times that are asked for increase.
    pub(super) fn at(&mut self, time_s: f64, maximum_gap_s: f64) -> Option<SeriesPoint> {
        while self.points.get(1).is_some_and(|&(next_s, _)| next_s <= time_s) {
            self.points.pop_front();
        }
        let &(before_s, before) = self.points.front().filter(|&&(before_s, _)| before_s <= time_s)?;
        #[expect(clippy::float_cmp, reason = "the time of one message")]
        if before_s == time_s {
            return Some(before);
        }
        let &(after_s, after) = self.points.get(1)?;
        let gap_s = after_s - before_s;
        (gap_s <= maximum_gap_s).then(|| before.between(&after, (time_s - before_s) / gap_s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_that_of_a_message_or_between_two_that_are_near() {
        let state = |q: f64| SeriesPoint { q, qd: 2.0, effort: f64::NAN };
        let mut series = JointTrace::default();
        for (time_s, q) in [(0.0, 1.0), (0.1, 2.0), (0.5, 6.0), (0.6, 7.0)] {
            series.push(time_s, state(q));
        }
        assert!(series.reaches(0.6) && !series.reaches(0.61));
        let q = |series: &mut JointTrace, time_s: f64| series.at(time_s, 0.2).map(|state| state.q);
        assert_eq!(q(&mut series, -0.1), None);
        assert_eq!(q(&mut series, 0.0), Some(1.0));
        assert!((q(&mut series, 0.025).unwrap() - 1.25).abs() < 1e-12);
        assert_eq!(q(&mut series, 0.1), Some(2.0));
        assert_eq!(q(&mut series, 0.3), None, "across a gap");
        assert!((q(&mut series, 0.55).unwrap() - 6.5).abs() < 1e-12);
        assert_eq!(q(&mut series, 0.7), None);
    }
}
