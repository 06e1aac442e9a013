//! `ratio`: a joint moves more or less than its variable says.

use crate::diagnosis::{
    candidate::ModelParameter,
    hypothesis::{Cause, Hypothesis, ModelPair, Place},
};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    let ratio = |row| Hypothesis::fit(Cause::Ratio, Place::Rows(vec![row]), vec![ModelParameter::Rate(row)]);
    (0..models.candidate.rows.len()).map(ratio).collect()
}
