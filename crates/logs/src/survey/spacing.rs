//! The nominal period of times, and the gaps between them.

use super::report::GapsSurvey;
use crate::event::{float, seconds};

/// A gap is longer than so many usual steps.
const GAP_STEPS: i64 = 5;
/// Times by which the usual step is decided. Kind: choice; half a second at 1 kHz, and 4 kB.
const HEAD: usize = 512;

/// Times in their order, of which only what is concluded is kept.
#[derive(Debug, Default)]
pub(super) struct Spacing {
    /// The first times, until the steps are judged.
    head: Vec<i64>,
    steps: Option<FirstSteps>,
    last_ns: Option<i64>,
    /// Number and sum of the steps that are no gaps.
    regular: u64,
    regular_ns: i64,
    count: u64,
    total_ns: i64,
    longest_ns: i64,
    longest_from_ns: i64,
}

/// The first steps, ns.
#[derive(Debug, Clone, Copy)]
struct FirstSteps {
    median_ns: i64,
    /// Nine of ten are no longer. Of two publishers at almost the same times, half of the steps are as good as none.
    usual_ns: i64,
}

/// How times are spaced.
#[derive(Debug, PartialEq)]
pub(super) struct Spaced {
    /// Steps a second, without gaps; `None` if all times are one.
    pub(super) rate_hz: Option<f64>,
    /// The median of the first steps, s.
    pub(super) period_s: Option<f64>,
    pub(super) gaps: Option<GapsSurvey>,
}

impl Spacing {
    /// Takes the next time.
    pub(super) fn take(&mut self, ns: i64) {
        if self.steps.is_some() {
            self.step_to(ns);
            return;
        }
        if self.head.last().is_none_or(|last| *last < ns) {
            self.head.push(ns);
        }
        if self.head.len() == HEAD {
            self.judge_head();
        }
    }

    /// The times that follow begin anew: the step to them is no gap.
    pub(super) fn begin_part(&mut self) {
        self.judge_head();
        self.last_ns = None;
    }

    /// Judges the steps by the times so far, if two differ.
    fn judge_head(&mut self) {
        let head = std::mem::take(&mut self.head);
        let mut steps: Vec<i64> = head.windows(2).map(|pair| pair[1].saturating_sub(pair[0])).collect();
        steps.sort_unstable();
        if let (None, Some(last)) = (self.steps, steps.len().checked_sub(1)) {
            self.steps =
                Some(FirstSteps { median_ns: steps[steps.len() / 2], usual_ns: steps[last * 9 / 10] });
        }
        for ns in head {
            self.step_to(ns);
        }
    }

    fn step_to(&mut self, ns: i64) {
        // A repeated time is no step; one that comes later than others can wait for begins none, since what is around it has
        // been judged.
        if self.last_ns.is_some_and(|last_ns| ns <= last_ns) {
            return;
        }
        let before = self.last_ns.replace(ns);
        let (Some(from_ns), Some(FirstSteps { usual_ns, .. })) = (before, self.steps) else { return };
        let step = ns.saturating_sub(from_ns);
        if step <= usual_ns.saturating_mul(GAP_STEPS) {
            self.regular += 1;
            self.regular_ns = self.regular_ns.saturating_add(step);
            return;
        }
        self.count += 1;
        self.total_ns = self.total_ns.saturating_add(step);
        if step > self.longest_ns {
            (self.longest_ns, self.longest_from_ns) = (step, from_ns);
        }
    }

    /// The rate, the period and the gaps; times are counted from `first_ns` on.
    pub(super) fn finish(mut self, first_ns: i64) -> Spaced {
        self.judge_head();
        let gaps = (self.count > 0).then(|| GapsSurvey {
            count: self.count,
            total_s: seconds(self.total_ns),
            longest_s: seconds(self.longest_ns),
            longest_from_s: seconds(self.longest_from_ns.saturating_sub(first_ns)),
        });
        let rate_hz = (self.regular_ns > 0).then(|| float(self.regular) / seconds(self.regular_ns));
        Spaced { rate_hz, period_s: self.steps.map(|steps| seconds(steps.median_ns)), gaps }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a millisecond with a gap of 100 before the time `gap_at`.
    fn surveyed(count: i64, gap_at: i64) -> Spaced {
        let mut spacing = Spacing::default();
        (0..count).for_each(|at| spacing.take(1_000_000 * if at < gap_at { at } else { at + 99 }));
        spacing.finish(0)
    }

    #[test]
    fn gaps_before_and_behind_the_times_that_decide_the_period() {
        for (count, gap_at) in [(20, 10), (2000, 100), (2000, 1500)] {
            let Spaced { rate_hz, period_s, gaps } = surveyed(count, gap_at);
            let gaps = gaps.unwrap();
            assert!((rate_hz.unwrap() - 1000.0).abs() < 1e-9);
            assert_eq!((period_s, gaps.count, gaps.longest_s), (Some(0.001), 1, 0.1));
            assert!((gaps.longest_from_s - seconds(1_000_000 * (gap_at - 1))).abs() < 1e-12);
        }
        assert_eq!(surveyed(2000, 3000).gaps, None);
        assert_eq!(surveyed(1, 3000), Spaced { rate_hz: None, period_s: None, gaps: None });
    }

    #[test]
    fn a_new_part_is_no_gap() {
        let mut spacing = Spacing::default();
        (0..100).for_each(|at| spacing.take(at));
        spacing.begin_part();
        (5000..5100).for_each(|at| spacing.take(at));
        assert_eq!(spacing.finish(0).gaps, None);
    }

    #[test]
    fn pairs_of_messages_are_no_gaps() {
        // Two publishers at 500 Hz, 0.1 ms apart.
        let mut spacing = Spacing::default();
        (0..2000).flat_map(|at| [at * 2_000_000, at * 2_000_000 + 100_000]).for_each(|ns| spacing.take(ns));
        let found = spacing.finish(0);
        assert!(found.gaps.is_none() && (found.rate_hz.unwrap() - 1000.0).abs() < 1.0, "{found:?}");
    }

    #[test]
    fn a_time_that_is_late_is_no_gap() {
        for late_at in [100, 1500] {
            let mut spacing = Spacing::default();
            let late = |at: i64| if at == late_at { at - 90 } else { at };
            (0..2000).for_each(|at| spacing.take(late(at) * 1_000_000));
            assert_eq!(spacing.finish(0).gaps, None);
        }
    }
}
