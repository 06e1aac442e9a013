//! What an actuator delivers of the effort that it is commanded to, over all samples of a run.

/// Delivered and commanded effort that differ by less than this part are equal. Kind: rounding; the physics delivers what is
/// commanded to the last bit.
const SAME_EFFORT: f64 = 1e-9;

/// Shares of one actuator that differ by less are the same. No unit; kind: rounding of a small effort.
const SAME_SHARE: f64 = 1e-6;

/// How much the largest commanded effort is above the smallest before a share says anything: an actuator at its limit delivers one share of
/// a command that does not change. No unit; kind: judgement.
const VARIED: f64 = 1.01;

/// The efforts of one joint that were seen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DeliveredEffort {
    /// Whether a sample had both efforts.
    is_known: bool,
    off: Option<OffSamples>,
}

/// The samples in which the actuator delivered another effort than the commanded one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OffSamples {
    first_step: u64,
    /// The first step after them that was delivered as commanded.
    end_step: Option<u64>,
    least_share: f64,
    most_share: f64,
    least_commanded: f64,
    most_commanded: f64,
    /// Whether they are one stretch of time.
    is_one_stretch: bool,
}

/// One part of the commanded effort that an actuator delivers, in each sample of a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantShare {
    /// Delivered by commanded effort.
    pub share: f64,
    /// The first step of which the share is another than 1.
    pub first_step: u64,
    /// The first step after them; `None` if the run ends before.
    pub end_step: Option<u64>,
}

impl DeliveredEffort {
    /// Takes the efforts of one step, N m or N.
    pub(crate) fn observe(&mut self, commanded: f64, delivered: f64, step: u64) {
        self.is_known = true;
        if (delivered - commanded).abs() <= SAME_EFFORT * commanded.abs() {
            // Nothing of nothing is any share.
            if let Some(off) = self.off.as_mut().filter(|_| commanded != 0.0) {
                off.end_step.get_or_insert(step);
            }
            return;
        }
        let share = delivered / commanded;
        let off = self.off.get_or_insert(OffSamples {
            first_step: step,
            end_step: None,
            least_share: share,
            most_share: share,
            least_commanded: commanded.abs(),
            most_commanded: commanded.abs(),
            is_one_stretch: true,
        });
        off.least_share = off.least_share.min(share);
        off.most_share = off.most_share.max(share);
        off.least_commanded = off.least_commanded.min(commanded.abs());
        off.most_commanded = off.most_commanded.max(commanded.abs());
        off.is_one_stretch &= off.end_step.is_none();
    }

    /// Whether the actuator delivered all that it was commanded to; `None` if the source does not know both efforts.
    pub fn is_all(&self) -> Option<bool> {
        self.is_known.then_some(self.off.is_none())
    }

    /// The one share that it delivered wherever it did not deliver all; `None` if it delivered all, or a share that changed.
    pub fn constant_share(&self) -> Option<ConstantShare> {
        let off = self.off.as_ref()?;
        let is_constant = off.most_share - off.least_share <= SAME_SHARE
            && off.most_commanded > VARIED * off.least_commanded
            && off.is_one_stretch;
        is_constant.then_some(ConstantShare {
            share: off.least_share,
            first_step: off.first_step,
            end_step: off.end_step,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observed(efforts: &[(f64, f64)]) -> DeliveredEffort {
        let mut seen = DeliveredEffort::default();
        for (step, (commanded, delivered)) in (1..).zip(efforts) {
            seen.observe(*commanded, *delivered, step);
        }
        seen
    }

    #[test]
    fn a_share_is_one_that_does_not_change() {
        let scaled = observed(&[(1.0, 1.0), (2.0, 1.6), (0.0, 0.0), (-5.0, -4.0)]).constant_share().unwrap();
        assert!((scaled.share - 0.8).abs() < 1e-12, "{scaled:?}");
        assert_eq!((scaled.first_step, scaled.end_step), (2, None));
        let until = observed(&[(2.0, 1.6), (-5.0, -4.0), (3.0, 3.0)]).constant_share().unwrap();
        assert_eq!((until.first_step, until.end_step), (1, Some(3)));
        // Saturated, and twice with a pause between.
        assert_eq!(observed(&[(10.0, 8.0), (12.0, 8.0)]).constant_share(), None);
        assert_eq!(observed(&[(10.0, 8.0), (1.0, 1.0), (10.0, 8.0)]).constant_share(), None);
        assert_eq!(observed(&[(10.0, 8.0), (10.0, 8.0)]).constant_share(), None);
        assert_eq!(observed(&[(10.0, 10.0)]).constant_share(), None);
    }

    #[test]
    fn without_both_efforts_nothing_is_known() {
        assert_eq!(DeliveredEffort::default().is_all(), None);
        assert_eq!(observed(&[(1.0, 1.0)]).is_all(), Some(true));
        assert_eq!(observed(&[(1.0, 1.0), (1.0, 0.0)]).is_all(), Some(false));
    }
}
