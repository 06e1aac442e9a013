//! Whether a person may have meant a length that was fitted: along parallel axes each length makes up for a wrong one, and
//! no measurement says which one it is.

use congruent_input::TypingError;

use super::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    explanation::Criterion,
    fit::hypothesis_fit::{FitContext, HypothesisFit},
    hypothesis::{ModelPair, PoseHypothesis},
    thresholds::SAME_VALUE,
};

/// One length that a hypothesis fits, in metres: an entry of a row, or a component of a declared transform.
pub(super) struct FittedLength {
    given: f64,
    fitted: f64,
    /// Half of the last place of the lengths in the files.
    half_place: f64,
}

impl FittedLength {
    /// `None` if a hypothesis fits anything else, or more than one value.
    pub(super) fn of_hypothesis(
        context: &FitContext<'_>,
        fit: &HypothesisFit,
        criterion: &Criterion,
        hypothesis: &PoseHypothesis,
    ) -> Option<Self> {
        let &[parameter] = &hypothesis.free[..] else { return None };
        let given = length_m(&context.models.candidate, parameter)?;
        let fitted = length_m(&context.corrected(fit).candidate, parameter)?;
        let half_place = criterion.digits.coarsest_half_place(DhEntry::A).max(SAME_VALUE);
        Some(Self { given, fitted, half_place })
    }

    /// Whether the table or the reference model's file has the fitted value elsewhere, with whatever sign, or it is zero.
    pub(super) fn is_written_elsewhere(&self, ModelPair { candidate, reference }: &ModelPair) -> bool {
        let is_same = |written: f64| (written.abs() - self.fitted.abs()).abs() <= self.half_place;
        let rows = 0..candidate.rows.len();
        let of_rows =
            rows.flat_map(|row| [DhEntry::A, DhEntry::D].map(|entry| candidate.entry(row, entry))).flatten();
        let transforms = [&candidate.base, &candidate.tool].map(|transform| transform.pose.translation);
        let origins = reference.joints.iter().filter(|joint| joint.is_written);
        let mut of_transforms = origins.map(|joint| joint.parent_from_joint.translation).chain(transforms);
        is_same(0.0)
            || of_rows.into_iter().any(is_same)
            || of_transforms.any(|translation| translation.iter().any(|&written| is_same(written)))
    }

    /// Whether another value was typed for one that is likelier: a zero is rarely a typing error.
    pub(super) fn is_likely(&self, models: &ModelPair) -> bool {
        self.given != 0.0 && self.is_explained(models)
    }

    /// Whether the fitted value is written elsewhere, or the given one is a typing error.
    pub(super) fn is_explained(&self, models: &ModelPair) -> bool {
        self.is_typing_error() || self.is_written_elsewhere(models)
    }

    /// Whether the fitted value becomes the given one by a mistake that people make when they type.
    pub(super) fn is_typing_error(&self) -> bool {
        TypingError::between_values(self.given, self.fitted).is_some()
    }
}

fn length_m(candidate: &CandidateModel, parameter: ModelParameter) -> Option<f64> {
    match parameter {
        ModelParameter::Row(row, entry) if !entry.is_angle() => candidate.entry(row, entry),
        ModelParameter::Base(component @ 0..3) => Some(candidate.base.pose.translation[component]),
        ModelParameter::Tool(component @ 0..3) => Some(candidate.tool.pose.translation[component]),
        _ => None,
    }
}
