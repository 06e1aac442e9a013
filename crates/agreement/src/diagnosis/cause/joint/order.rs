//! `joints_swapped`: two joints' names or whole rows are exchanged.

use crate::diagnosis::hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let rows = models.candidate.rows.len();
    let pairs = (0..rows).flat_map(|second| (0..second).map(move |first| (first, second)));
    pairs.flat_map(|(first, second)| [names(first, second), whole_rows(first, second)]).collect()
}

/// The joint names are exchanged, the values are in the right rows.
fn names(first: usize, second: usize) -> PoseHypothesis {
    PoseHypothesis::edit(
        Cause::JointsSwapped,
        FaultPlace::Rows(vec![first, second]),
        move |models: &mut ModelPair| {
            let rows = &mut models.candidate.rows;
            (rows[first].joint, rows[second].joint) = (rows[second].joint, rows[first].joint);
        },
    )
}

/// Names and values are exchanged together.
fn whole_rows(first: usize, second: usize) -> PoseHypothesis {
    PoseHypothesis::edit(
        Cause::JointsSwapped,
        FaultPlace::Rows(vec![first, second]),
        move |models: &mut ModelPair| {
            models.candidate.rows.swap(first, second);
        },
    )
}
