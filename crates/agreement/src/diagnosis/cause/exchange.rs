//! `parameters_exchanged`: `a` and `d` of a row, `alpha` of neighbouring rows, or two columns of the whole table
//! are exchanged.

use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let rows = candidate.rows.len();
    let lengths = (0..rows)
        .filter(|&row| candidate.entry(row, DhEntry::A).is_some())
        .map(|row| exchanged(FaultPlace::Rows(vec![row]), [row; 2], [DhEntry::A, DhEntry::D]));
    // The conventions differ by one row in where `alpha` belongs, which is the usual reason for this exchange.
    let twists = (1..rows).filter(|&row| candidate.entry(row, DhEntry::Alpha).is_some()).map(|row| {
        let place = FaultPlace::Entries(DhEntry::Alpha, vec![row - 1, row]);
        exchanged(place, [row - 1, row], [DhEntry::Alpha; 2])
    });
    lengths.chain(twists).chain(COLUMNS.map(columns)).collect()
}

/// Columns that a reader may take for each other: both lengths, and both angles.
const COLUMNS: [[DhEntry; 2]; 2] = [[DhEntry::A, DhEntry::D], [DhEntry::Alpha, DhEntry::Theta]];

fn columns(entries: [DhEntry; 2]) -> PoseHypothesis {
    let place = FaultPlace::Column(entries.to_vec());
    PoseHypothesis::edit(Cause::ParametersExchanged, place, move |models: &mut ModelPair| {
        for row in 0..models.candidate.rows.len() {
            swap(&mut models.candidate, [row; 2], entries);
        }
    })
}

fn exchanged(place: FaultPlace, rows: [usize; 2], entries: [DhEntry; 2]) -> PoseHypothesis {
    PoseHypothesis::edit(Cause::ParametersExchanged, place, move |models: &mut ModelPair| {
        swap(&mut models.candidate, rows, entries);
    })
}

/// Exchanges the first entry in the first row with the second entry in the second row.
fn swap(candidate: &mut CandidateModel, rows: [usize; 2], entries: [DhEntry; 2]) {
    let [Some(first), Some(second)] = [0, 1].map(|at| candidate.entry(rows[at], entries[at])) else { return };
    for (at, value) in [second, first].into_iter().enumerate() {
        if let Some(place) = candidate.entry_mut(rows[at], entries[at]) {
            *place = value;
        }
    }
}
