//! `parameters_exchanged`: two values of a row, the values of one entry in two rows, or two columns of the whole table
//! are exchanged.

use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

/// Entries that a reader may take for each other: both lengths, and both angles.
const ALIKE: [[DhEntry; 2]; 2] = [[DhEntry::A, DhEntry::D], [DhEntry::Alpha, DhEntry::Theta]];

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let rows = candidate.rows.len();
    let has_entries = |row: &usize| candidate.entry(*row, DhEntry::A).is_some();
    let mut list: Vec<PoseHypothesis> = Vec::new();
    for row in (0..rows).filter(has_entries) {
        list.push(exchanged(FaultPlace::Rows(vec![row]), [row; 2], ALIKE[0]));
        list.push(exchanged(FaultPlace::RowEntries(ALIKE[1].to_vec(), row), [row; 2], ALIKE[1]));
    }
    for entry in DhEntry::ALL {
        for second in (0..rows).filter(has_entries) {
            for first in 0..second {
                // Equal values have no order. Of a long chain only neighbours: the number of pairs is the square of
                // that of the rows.
                let is_near = second - first == 1 || rows <= MAX_ROWS;
                if is_near && candidate.entry(first, entry) != candidate.entry(second, entry) {
                    let place = FaultPlace::Entries(entry, vec![first, second]);
                    list.push(exchanged(place, [first, second], [entry; 2]));
                }
            }
        }
    }
    list.extend(ALIKE.map(columns));
    list
}

/// Most rows of a table in which the values of any two rows may be exchanged. Kind: speed; published arms have up to 8.
const MAX_ROWS: usize = 10;

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
