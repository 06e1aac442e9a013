//! Three or more joints that move in the opposite direction: tables of some makers have no signs at all, and one or
//! two corrected signs alone do not reduce the difference.

use super::ExplanationSearch;
use crate::diagnosis::{
    fit::hypothesis_fit::HypothesisFit,
    hypothesis::Cause,
    thresholds::{MAX_FLIPPED_JOINTS, PAIR},
};

impl ExplanationSearch<'_> {
    /// Every set of joints larger than a pair turned around; none for chains with too many joints.
    pub(super) fn flips(&self) -> Vec<HypothesisFit> {
        let is_flip = |at: &usize| self.context.hypotheses[*at].cause == Cause::AxisFlipped;
        let flips: Vec<usize> = (0..self.context.hypotheses.len()).filter(is_flip).collect();
        // The number of sets doubles with each joint.
        if flips.len() > MAX_FLIPPED_JOINTS {
            return Vec::new();
        }
        let chosen = |set: u32| -> Vec<usize> {
            flips.iter().enumerate().filter(|(bit, _)| set >> bit & 1 == 1).map(|(_, &at)| at).collect()
        };
        // Bit `n` of `set` says whether joint `n` is turned around; one and two joints are tried elsewhere.
        let sets = (0..1_u32 << flips.len()).map(chosen).filter(|set| set.len() > PAIR);
        sets.map(|set| self.context.fit(set, &[])).collect()
    }
}
