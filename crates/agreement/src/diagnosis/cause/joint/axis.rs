//! `axis_flipped`: a joint moves in the opposite direction.

use crate::diagnosis::hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let flipped = |row: usize| {
        PoseHypothesis::edit(
            Cause::AxisFlipped,
            FaultPlace::Rows(vec![row]),
            move |models: &mut ModelPair| {
                models.candidate.rows[row].rate *= -1.0;
            },
        )
    };
    (0..models.candidate.rows.len()).map(flipped).collect()
}
