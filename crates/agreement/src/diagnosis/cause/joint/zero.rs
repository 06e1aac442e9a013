//! `zero_offset`: a joint's zero is shifted.

use crate::diagnosis::{
    candidate::ModelParameter,
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let zero = |row: usize| {
        let entry = candidate.zero_entry(row);
        let place = FaultPlace::Entries(entry, vec![row]);
        candidate.entry(row, entry)?;
        Some(PoseHypothesis::fit(Cause::ZeroOffset, place, vec![ModelParameter::Row(row, entry)]))
    };
    (0..candidate.rows.len()).filter_map(zero).collect()
}
