//! When checks leave their limits and come back.

use congruent_input::Quantity;
use congruent_monitors::{Names, RunningCheck, Sample, verdict::InstantValue};

use super::line::{CheckChange, WatchLine};

/// What was said of a check so far.
#[derive(Debug, Clone, Copy, Default)]
struct CheckState {
    /// The quantity whose value at the last instant that had one was outside its limit.
    outside: Option<Quantity>,
    /// The check has failed, and that was said.
    has_failed: bool,
}

/// What was said of all checks so far.
#[derive(Debug, Default)]
pub(super) struct CheckStates {
    states: Vec<CheckState>,
}

impl CheckStates {
    /// What has changed with this sample, whose time in the stream is `time_s`.
    pub(super) fn changes(
        &mut self,
        time_s: f64,
        sample: &Sample<'_>,
        checks: &[RunningCheck<'_>],
        names: &Names,
    ) -> Vec<WatchLine> {
        self.states.resize(checks.len(), CheckState::default());
        let mut changes = Vec::new();
        for (number, (check, state)) in checks.iter().zip(&mut self.states).enumerate() {
            let values = || sample.values.iter().filter(|value| value.check == number).map(|value| value.of);
            let is_outside = |of: &InstantValue| !of.bound.holds(of.value, of.limit);
            let instant = ChangingCheck { number, check, names, time_s };
            match (values().find(is_outside), state.outside) {
                (Some(value), None) => {
                    changes.push(WatchLine::Violation(instant.change(&value)));
                    *state = CheckState { outside: Some(value.quantity), has_failed: true };
                }
                (None, Some(quantity)) => {
                    if let Some(value) = values().find(|value| value.quantity == quantity) {
                        changes.push(WatchLine::Recovered(instant.change(&value)));
                        state.outside = None;
                    }
                }
                (Some(_), Some(_)) | (None, None) => {}
            }
            if check.monitor.has_failed() && !state.has_failed {
                // Values that are found later, as a jump, or not at each instant, as a distance.
                state.has_failed = true;
                let later_s = time_s - sample.time_s;
                changes.extend(instant.failed(later_s).map(WatchLine::Violation));
            }
        }
        changes
    }
}

/// A check of which something has changed.
struct ChangingCheck<'a, 'b> {
    number: usize,
    check: &'a RunningCheck<'b>,
    names: &'a Names,
    time_s: f64,
}

impl ChangingCheck<'_, '_> {
    fn change(&self, of: &InstantValue) -> CheckChange {
        let InstantValue { quantity, unit, bound, limit, value, .. } = *of;
        let subject = self.names.subject(self.check.kind, of).map(str::to_owned);
        CheckChange {
            time_s: self.time_s,
            check: self.check.kind,
            number: self.number + 1,
            quantity,
            value,
            limit,
            unit,
            bound,
            subject: subject.or_else(|| self.subject_of_worst(of)),
        }
    }

    /// The name of a value that is the worst so far: the check knows it.
    fn subject_of_worst(&self, of: &InstantValue) -> Option<String> {
        let measures = self.check.monitor.finish(self.names).measures;
        let same = measures.into_iter().find(|measure| measure.quantity == of.quantity)?;
        let moments = [same.worst, same.first_violation].into_iter().flatten();
        #[expect(clippy::float_cmp, reason = "the same value")]
        moments.into_iter().find(|moment| moment.value == of.value).map(|moment| moment.subject)
    }

    /// The first violation of the check, with the clock of the stream.
    fn failed(&self, later_s: f64) -> Option<CheckChange> {
        let measures = self.check.monitor.finish(self.names).measures;
        let (measure, moment) =
            measures.into_iter().find_map(|mut of| of.first_violation.take().map(|moment| (of, moment)))?;
        Some(CheckChange {
            time_s: moment.time_s + later_s,
            check: self.check.kind,
            number: self.number + 1,
            quantity: measure.quantity,
            value: moment.value,
            limit: measure.limit,
            unit: measure.unit,
            bound: measure.bound,
            subject: Some(moment.subject),
        })
    }
}
