//! The catalogue of hypotheses: one file for each family of causes, those of joints in `joint/`. A new family is a
//! file here and a line in [`FAMILIES`].

mod constants;
mod convention;
mod exchange;
mod joint;
mod parameter;
mod rounding;
mod rpy;
mod shift;
mod sign;
mod units;

use super::hypothesis::{ModelPair, PoseHypothesis};

/// The hypotheses of one family about a pair of models.
type Family = fn(&ModelPair) -> Vec<PoseHypothesis>;

/// All families of hypotheses.
// Edits before fits: the order decides last, between explanations of equal rank, and an edit that is undone exactly
// is the likelier one.
const FAMILIES: [Family; 15] = [
    joint::axis::hypotheses,
    convention::hypotheses,
    joint::order::hypotheses,
    joint::kind::hypotheses,
    units::hypotheses,
    exchange::hypotheses,
    shift::hypotheses,
    sign::hypotheses,
    rpy::hypotheses,
    joint::fixed_joint::hypotheses,
    rounding::hypotheses,
    joint::zero::hypotheses,
    constants::hypotheses,
    parameter::hypotheses,
    joint::ratio::hypotheses,
];

/// All hypotheses about a pair of models.
pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    FAMILIES.iter().flat_map(|family| family(models)).collect()
}
