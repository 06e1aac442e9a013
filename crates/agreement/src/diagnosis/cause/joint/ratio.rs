//! `ratio`: a joint moves more or less than its variable says.

use crate::diagnosis::{
    candidate::ModelParameter,
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let ratio =
        |row| PoseHypothesis::fit(Cause::Ratio, FaultPlace::Rows(vec![row]), vec![ModelParameter::Rate(row)]);
    (0..models.candidate.rows.len()).map(ratio).collect()
}
