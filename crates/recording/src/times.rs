//! The two timelines: simulated time and physics steps. There is no wall clock in a recording.

use re_chunk::TimeColumn;
use re_log_types::{TimeInt, TimePoint, Timeline};

/// Name of the timeline of simulated time.
pub(super) const SIM_TIME: &str = "sim_time";
/// Name of the timeline of steps.
const STEP: &str = "step";

/// One instant on both timelines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Instant {
    /// Simulated time from the start, rounded to nanoseconds.
    pub(super) nanoseconds: i64,
    /// Physics steps from the start.
    pub(super) step: i64,
}

impl Instant {
    /// The instant after `step` steps, at `time_s`.
    pub(super) fn new(time_s: f64, step: u64) -> Self {
        Self { nanoseconds: nanoseconds(time_s), step: i64::try_from(step).unwrap_or(i64::MAX) }
    }

    /// The instant as rerun takes it for a single row.
    pub(super) fn point(self) -> TimePoint {
        TimePoint::default()
            .with(Timeline::new_duration(SIM_TIME), TimeInt::new_temporal(self.nanoseconds))
            .with(Timeline::new_sequence(STEP), TimeInt::new_temporal(self.step))
    }
}

/// Nanoseconds; what is beyond their range, 292 years, is at its end.
#[expect(clippy::cast_possible_truncation, reason = "the cast of floats saturates, as documented")]
pub(super) fn nanoseconds(time_s: f64) -> i64 {
    (time_s * 1e9).round() as i64
}

/// Instants of many rows.
#[derive(Debug, Default)]
pub(super) struct Times {
    nanoseconds: Vec<i64>,
    steps: Vec<i64>,
}

impl Times {
    /// Room for a number of instants.
    pub(super) fn with_capacity(rows: usize) -> Self {
        Self { nanoseconds: Vec::with_capacity(rows), steps: Vec::with_capacity(rows) }
    }

    /// Adds an instant, later than all before.
    pub(super) fn push(&mut self, instant: Instant) {
        self.nanoseconds.push(instant.nanoseconds);
        self.steps.push(instant.step);
    }

    /// Number of instants.
    pub(super) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// Forgets all, keeps the room.
    pub(super) fn clear(&mut self) {
        self.nanoseconds.clear();
        self.steps.clear();
    }

    /// The instants as rerun takes them for columns.
    pub(super) fn columns(&self) -> [TimeColumn; 2] {
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
}
