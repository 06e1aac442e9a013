//! `convention_swapped`: a standard table read as modified, or the reverse.

use congruent_description::DhConvention;

use crate::diagnosis::hypothesis::{Case, Cause, Hypothesis, Place};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let Some(convention) = case.suspect.convention else { return Vec::new() };
    let other = match convention {
        DhConvention::Standard => DhConvention::Modified,
        DhConvention::Modified => DhConvention::Standard,
    };
    vec![Hypothesis::edit(Cause::ConventionSwapped, Place::Model, move |case| {
        case.suspect.convention = Some(other);
    })]
}
