//! The two timelines: simulated time and physics steps. A recording holds no wall-clock time.

use re_chunk::TimeColumn;
use re_log_types::{TimeInt, TimePoint, Timeline};

/// Name of the timeline of simulated time.
pub(crate) const SIM_TIME: &str = "sim_time";
/// Name of the timeline of steps.
const STEP: &str = "step";

/// Simulated time between two recorded samples; every step is recorded if steps are longer.
const PERIOD_S: f64 = 0.01;

/// Steps between two recorded samples.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a step is positive, and the cast of floats saturates"
)]
pub(crate) fn stride(step_s: f64) -> u64 {
    ((PERIOD_S / step_s).round() as u64).max(1)
}

/// The time of one sample on both timelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SampleTime {
    /// Simulated time from the start, rounded to nanoseconds.
    pub(crate) nanoseconds: i64,
    /// Physics steps from the start.
    pub(crate) step: i64,
}

impl SampleTime {
    /// The time after `step` steps, at `time_s`.
    pub(crate) fn new(time_s: f64, step: u64) -> Self {
        Self { nanoseconds: nanoseconds(time_s), step: i64::try_from(step).unwrap_or(i64::MAX) }
    }

    /// The time in rerun's type for a single row.
    pub(crate) fn point(self) -> TimePoint {
        TimePoint::default()
            .with(Timeline::new_duration(SIM_TIME), TimeInt::new_temporal(self.nanoseconds))
            .with(Timeline::new_sequence(STEP), TimeInt::new_temporal(self.step))
    }
}

/// Whole nanoseconds; a time beyond their range of 292 years becomes the end of the range.
#[expect(clippy::cast_possible_truncation, reason = "the cast of floats saturates, as documented")]
pub(crate) fn nanoseconds(time_s: f64) -> i64 {
    (time_s * 1e9).round() as i64
}

/// Seconds from whole nanoseconds, the reverse of `nanoseconds`.
#[expect(clippy::cast_precision_loss, reason = "2^53 nanoseconds are 104 days")]
pub(crate) fn seconds(nanoseconds: i64) -> f64 {
    nanoseconds as f64 / 1e9
}

/// The times of many rows.
#[derive(Debug, Default)]
pub(crate) struct SampleTimes {
    nanoseconds: Vec<i64>,
    steps: Vec<i64>,
}

impl SampleTimes {
    /// No times, with memory for a number of rows.
    pub(crate) fn with_capacity(rows: usize) -> Self {
        Self { nanoseconds: Vec::with_capacity(rows), steps: Vec::with_capacity(rows) }
    }

    /// Adds a time, later than all before.
    pub(crate) fn push(&mut self, time: SampleTime) {
        self.nanoseconds.push(time.nanoseconds);
        self.steps.push(time.step);
    }

    /// Number of rows, one for each recorded time.
    pub(crate) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether there are no rows.
    pub(crate) fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Removes all rows and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.nanoseconds.clear();
        self.steps.clear();
    }

    /// The times in rerun's type for columns.
    pub(crate) fn columns(&self) -> [TimeColumn; 2] {
        [
            TimeColumn::new(Some(true), Timeline::new_duration(SIM_TIME), self.nanoseconds.clone().into()),
            TimeColumn::new(Some(true), Timeline::new_sequence(STEP), self.steps.clone().into()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milliseconds_are_whole_nanoseconds() {
        for step in [0_u32, 1, 3, 999, 1234, 86_400_000] {
            assert_eq!(nanoseconds(f64::from(step) * 0.001), i64::from(step) * 1_000_000);
        }
    }

    #[test]
    fn a_hundred_samples_a_second_at_most() {
        assert_eq!([0.001, 0.002, 0.01, 0.0004, 0.005].map(stride), [10, 5, 1, 25, 2]);
        assert_eq!(stride(1e-9), 10_000_000);
    }
}
