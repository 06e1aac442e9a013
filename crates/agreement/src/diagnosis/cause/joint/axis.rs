//! `axis_flipped`: a joint moves in the opposite direction.

use crate::diagnosis::hypothesis::{Cause, Hypothesis, ModelPair, Place};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    let flipped = |row: usize| {
        Hypothesis::edit(Cause::AxisFlipped, Place::Rows(vec![row]), move |models: &mut ModelPair| {
            models.candidate.rows[row].rate *= -1.0;
        })
    };
    (0..models.candidate.rows.len()).map(flipped).collect()
}
