//! The clock of a digital controller: when it computes, and when its torques act.

use crate::setup::ControlPeriod;

/// Holds torques between the instants of a controller, and delays them.
#[derive(Debug, Clone)]
pub(super) struct Hold {
    sampling: ControlPeriod,
    step: u64,
    /// The torques of this step and of those that are delayed: `delay + 1` rows, a ring.
    torques: Vec<Vec<f64>>,
}

impl Hold {
    pub(super) fn new(sampling: ControlPeriod, dof: usize) -> Self {
        Self { sampling, step: 0, torques: vec![vec![0.0; dof]; sampling.delay + 1] }
    }

    /// Steps from one computation to the next.
    pub(super) fn period(&self) -> u64 {
        self.sampling.period
    }

    /// The torques of this step. `compute` gives new ones if it is time for them; the first act at once, as if the
    /// controller had stood in this state before the run.
    pub(super) fn next(&mut self, compute: impl FnOnce(&mut [f64])) -> &[f64] {
        let rows = self.torques.len() as u64;
        #[expect(clippy::cast_possible_truncation, reason = "below the number of rows")]
        // Row `step % rows` is this step's; the row after it in the ring was written `delay` steps ago. With a single
        // row all three are the same.
        let [now, before, oldest] = [rows, rows - 1, 1].map(|ahead| ((self.step + ahead) % rows) as usize);
        if self.step.is_multiple_of(self.sampling.period) {
            compute(&mut self.torques[now]);
        } else if now != before {
            let [new, held] = self.torques.get_disjoint_mut([now, before]).expect("two rows of the ring");
            new.copy_from_slice(held);
        }
        if self.step == 0 {
            let first = self.torques[now].clone();
            self.torques.iter_mut().for_each(|torques| torques.copy_from_slice(&first));
        }
        self.step += 1;
        &self.torques[oldest]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn torques(period: u64, delay: usize, expected: &[f64]) {
        let mut hold = Hold::new(ControlPeriod { period, delay }, 1);
        let found: Vec<f64> = (0..expected.len())
            .map(|step| hold.next(|torque| torque[0] = f64::from(u8::try_from(step).unwrap()))[0])
            .collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn torques_hold_for_a_period_and_act_after_the_delay() {
        torques(1, 0, &[0.0, 1.0, 2.0, 3.0]);
        torques(3, 0, &[0.0, 0.0, 0.0, 3.0, 3.0, 3.0, 6.0]);
        torques(1, 2, &[0.0, 0.0, 0.0, 1.0, 2.0, 3.0]);
        torques(2, 3, &[0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 4.0]);
    }
}
