//! `zero_offset`: a joint's zero is shifted.

use crate::diagnosis::{
    candidate::ModelParameter,
    hypothesis::{Cause, Hypothesis, ModelPair, Place},
};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<Hypothesis> {
    let candidate = &models.candidate;
    let zero = |row: usize| {
        let entry = candidate.zero_entry(row);
        let place = Place::Entries(entry, vec![row]);
        candidate.entry(row, entry)?;
        Some(Hypothesis::fit(Cause::ZeroOffset, place, vec![ModelParameter::Row(row, entry)]))
    };
    (0..candidate.rows.len()).filter_map(zero).collect()
}
