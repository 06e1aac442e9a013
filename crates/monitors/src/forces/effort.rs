//! The effort that each actuator delivers against the effort that it is commanded to: an actuator that delivers a part of it, or
//! more, moves an arm with feedback nearly as well, so that no other check sees it.

use congruent_input::{Quantity, SiUnit};
use congruent_scenario::EffortCheck;

use super::not_evaluated::NotEvaluated;
use crate::{
    CheckContext, Names, StepForces,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Default limit. Kind: engineering; torque at a joint is measured to some hundredths. The physics delivers what is commanded to
/// the last bit.
pub(crate) const RELATIVE: f64 = 0.05;
/// A commanded effort counts as at least this part of the largest one of its joint so far: near zero any difference is a large
/// part of it. Kind: engineering.
const PART_OF_LARGEST: f64 = 0.1;
/// And as at least this much, N m or N. Kind: rounding.
const SMALLEST: f64 = 1e-6;

pub(crate) struct EffortMonitor {
    difference: Watch,
    /// The largest commanded effort of each joint so far.
    largest: Vec<f64>,
    compared: u64,
    not_evaluated: NotEvaluated,
}

impl EffortMonitor {
    pub(crate) fn new(check: &EffortCheck, context: &CheckContext<'_>) -> Self {
        let dof = context.dof();
        let limit = check.relative.unwrap_or(RELATIVE);
        Self {
            difference: Watch::new(Quantity::EffortError, SiUnit::Ratio, Bound::AtMost, limit, dof),
            largest: vec![0.0; dof],
            compared: 0,
            not_evaluated: NotEvaluated::default(),
        }
    }
}

impl Monitor for EffortMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        // No step leads to the first sample.
        if sample.step == 0 {
            return;
        }
        let delivered = sample.joints.state().effort;
        let commanded = sample.joints.setpoint.map_or(&[][..], |setpoint| setpoint.effort);
        let has_both = delivered.len() == self.largest.len() && commanded.len() == self.largest.len();
        if !has_both || sample.forces == StepForces::Unknown {
            self.not_evaluated.unknown += 1;
            return;
        }
        self.compared += 1;
        for (joint, (commanded, delivered)) in commanded.iter().zip(delivered).enumerate() {
            let largest = &mut self.largest[joint];
            *largest = largest.max(commanded.abs());
            let scale = commanded.abs().max(PART_OF_LARGEST * *largest).max(SMALLEST);
            self.difference.observe((delivered - commanded).abs() / scale, joint, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let measure = self.difference.measure(&names.joints, |joint| names.joints[joint].clone());
        Observed {
            samples: self.compared,
            not_evaluated: self.not_evaluated.count(),
            measures: vec![measure],
            notes: self.not_evaluated.notes(self.compared),
            ..Observed::default()
        }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        self.difference.at(time_s).into_iter().for_each(take);
    }

    fn has_failed(&self) -> bool {
        self.difference.is_violated()
    }
}
