//! The nominal period of times, and the gaps between them.

use super::report::GapsSurvey;
use crate::event::seconds;

/// A gap is longer than so many nominal periods.
const GAP_PERIODS: i64 = 5;
/// Times by which the nominal period is decided. Kind: choice; half a second at 1 kHz, and 4 kB.
const HEAD: usize = 512;

/// Times in their order, of which only what is concluded is kept.
#[derive(Debug, Default)]
pub(super) struct Spacing {
    /// The first times, until the period is decided.
    head: Vec<i64>,
    period_ns: Option<i64>,
    last_ns: Option<i64>,
    count: u64,
    total_ns: i64,
    longest_ns: i64,
    longest_from_ns: i64,
}

impl Spacing {
    /// Takes the next time; none is before the one before.
    pub(super) fn take(&mut self, ns: i64) {
        if self.period_ns.is_some() {
            self.step_to(ns);
            return;
        }
        if self.head.last() != Some(&ns) {
            self.head.push(ns);
        }
        if self.head.len() == HEAD {
            self.decide();
        }
    }

    /// The times that follow begin anew: the step to them is no gap.
    pub(super) fn begin_part(&mut self) {
        self.decide();
        self.last_ns = None;
    }

    /// Decides the period by the times so far, if there are two.
    fn decide(&mut self) {
        let head = std::mem::take(&mut self.head);
        let mut steps: Vec<i64> = head.windows(2).map(|pair| pair[1].saturating_sub(pair[0])).collect();
        steps.sort_unstable();
        if self.period_ns.is_none() {
            self.period_ns = steps.get(steps.len() / 2).copied();
        }
        for ns in head {
            self.step_to(ns);
        }
    }

    fn step_to(&mut self, ns: i64) {
        let before = self.last_ns.replace(ns);
        let (Some(from_ns), Some(period_ns)) = (before, self.period_ns) else { return };
        let step = ns.saturating_sub(from_ns);
        if step > period_ns.saturating_mul(GAP_PERIODS) {
            self.count += 1;
            self.total_ns = self.total_ns.saturating_add(step);
            if step > self.longest_ns {
                (self.longest_ns, self.longest_from_ns) = (step, from_ns);
            }
        }
    }

    /// The period in s, and the gaps; times are counted from `first_ns` on.
    pub(super) fn finish(mut self, first_ns: i64) -> (Option<f64>, Option<GapsSurvey>) {
        self.decide();
        let gaps = (self.count > 0).then(|| GapsSurvey {
            count: self.count,
            total_s: seconds(self.total_ns),
            longest_s: seconds(self.longest_ns),
            longest_from_s: seconds(self.longest_from_ns.saturating_sub(first_ns)),
        });
        (self.period_ns.map(seconds), gaps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a millisecond with a gap of 100 before the time `gap_at`.
    fn surveyed(count: i64, gap_at: i64) -> (Option<f64>, Option<GapsSurvey>) {
        let mut spacing = Spacing::default();
        (0..count).for_each(|at| spacing.take(1_000_000 * if at < gap_at { at } else { at + 99 }));
        spacing.finish(0)
    }

    #[test]
    fn gaps_before_and_behind_the_times_that_decide_the_period() {
        for (count, gap_at) in [(20, 10), (2000, 100), (2000, 1500)] {
            let (period_s, gaps) = surveyed(count, gap_at);
            let gaps = gaps.unwrap();
            assert_eq!((period_s, gaps.count, gaps.longest_s), (Some(0.001), 1, 0.1));
            assert!((gaps.longest_from_s - seconds(1_000_000 * (gap_at - 1))).abs() < 1e-12);
        }
        assert_eq!(surveyed(2000, 3000), (Some(0.001), None));
        assert_eq!(surveyed(1, 3000), (None, None));
    }

    #[test]
    fn a_new_part_is_no_gap() {
        let mut spacing = Spacing::default();
        (0..100).for_each(|at| spacing.take(at));
        spacing.begin_part();
        (5000..5100).for_each(|at| spacing.take(at));
        assert_eq!(spacing.finish(0).1, None);
    }
}
