//! Two likely corrections in place of a whole transform: behind or before parallel axes, six free numbers make up for a
//! length and an angle that are wrong in the rows.

use crate::diagnosis::{
    candidate::ModelParameter,
    fit::hypothesis_fit::HypothesisFit,
    fitted_length::FittedLength,
    hypothesis::{FaultPlace, PoseHypothesis},
    thresholds::QUARTER_TURNS,
};

use super::ExplanationSearch;

impl ExplanationSearch<'_> {
    /// The pairs of likely corrections that explain everything, if otherwise only fits of a whole transform do.
    pub(super) fn in_place_of_transforms(
        &self,
        accepted: &[HypothesisFit],
        others: &[HypothesisFit],
    ) -> Vec<HypothesisFit> {
        let is_transform = |fit: &HypothesisFit| {
            let hypotheses = fit.hypotheses.iter().map(|&at| &self.context.hypotheses[at]);
            let mut whole = hypotheses
                .filter(|it| matches!(it.place, FaultPlace::Base | FaultPlace::Tool) && it.free.len() > 1);
            whole.next().is_some()
        };
        if !accepted.iter().all(is_transform) {
            return Vec::new();
        }
        let mut pairs = self.pairs(others).accepted;
        pairs
            .retain(|fit| fit.hypotheses.iter().all(|&at| self.is_likely(fit, &self.context.hypotheses[at])));
        pairs
    }

    /// Whether a correction has no free value, or one that a person may have meant.
    fn is_likely(&self, fit: &HypothesisFit, hypothesis: &PoseHypothesis) -> bool {
        let models = self.context.models;
        if let Some(length) = FittedLength::of_hypothesis(self.context, fit, self.criterion, hypothesis) {
            return length.is_likely(models);
        }
        match hypothesis.free[..] {
            [] => true,
            [ModelParameter::Row(row, entry)] => {
                let corrected = self.context.corrected(fit).candidate.entry(row, entry);
                // An angle that is typed where the other file has none.
                corrected.is_some_and(|angle| angle.abs() < QUARTER_TURNS)
                    && models.candidate.entry(row, entry) != Some(0.0)
            }
            _ => false,
        }
    }
}
