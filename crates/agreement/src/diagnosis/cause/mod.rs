//! The catalogue of hypotheses: one file for each family of causes. A new family is a file here and a line in
//! [`FAMILIES`].

mod axis;
mod constants;
mod convention;
mod exchange;
mod fixed_joint;
mod kind;
mod order;
mod parameter;
mod ratio;
mod rounding;
mod rpy;
mod units;
mod zero;

use super::hypothesis::{Hypothesis, ModelPair};

/// The hypotheses of one family about a pair of models.
type Family = fn(&ModelPair) -> Vec<Hypothesis>;

/// All families.
const FAMILIES: [Family; 13] = [
    axis::hypotheses,
    convention::hypotheses,
    order::hypotheses,
    kind::hypotheses,
    units::hypotheses,
    exchange::hypotheses,
    rpy::hypotheses,
    fixed_joint::hypotheses,
    rounding::hypotheses,
    zero::hypotheses,
    constants::hypotheses,
    parameter::hypotheses,
    ratio::hypotheses,
];

/// All hypotheses about a pair of models.
pub(super) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    FAMILIES.iter().flat_map(|family| family(models)).collect()
}
