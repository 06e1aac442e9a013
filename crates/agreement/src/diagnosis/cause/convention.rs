//! `convention_swapped`: a standard table read as modified, or the reverse.

use congruent_description::DhConvention;

use crate::diagnosis::hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis};

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let Some(convention) = models.candidate.convention else { return Vec::new() };
    let other = match convention {
        DhConvention::Standard => DhConvention::Modified,
        DhConvention::Modified => DhConvention::Standard,
    };
    vec![PoseHypothesis::edit(Cause::ConventionSwapped, FaultPlace::Model, move |models| {
        models.candidate.convention = Some(other);
    })]
}
