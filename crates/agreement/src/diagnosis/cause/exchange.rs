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
        .map(|row| exchanged(FaultPlace::Rows(vec![row]), (row, DhEntry::A), (row, DhEntry::D)));
    // The conventions differ by one row in where `alpha` belongs, which is the usual reason for this exchange.
    let twists = (1..rows).filter(|&row| candidate.entry(row, DhEntry::Alpha).is_some()).map(|row| {
        let place = FaultPlace::Entries(DhEntry::Alpha, vec![row - 1, row]);
        exchanged(place, (row - 1, DhEntry::Alpha), (row, DhEntry::Alpha))
    });
    lengths.chain(twists).chain(COLUMNS.map(columns)).collect()
}

/// Columns that a reader may take for each other: both lengths, and both angles.
const COLUMNS: [[DhEntry; 2]; 2] = [[DhEntry::A, DhEntry::D], [DhEntry::Alpha, DhEntry::Theta]];

fn columns([first, second]: [DhEntry; 2]) -> PoseHypothesis {
    let place = FaultPlace::Column(vec![first, second]);
    PoseHypothesis::edit(Cause::ParametersExchanged, place, move |models: &mut ModelPair| {
        for row in 0..models.candidate.rows.len() {
            swap(&mut models.candidate, (row, first), (row, second));
        }
    })
}

fn exchanged(place: FaultPlace, first: (usize, DhEntry), second: (usize, DhEntry)) -> PoseHypothesis {
    PoseHypothesis::edit(Cause::ParametersExchanged, place, move |models: &mut ModelPair| {
        swap(&mut models.candidate, first, second);
    })
}

fn swap(candidate: &mut CandidateModel, first: (usize, DhEntry), second: (usize, DhEntry)) {
    let (Some(at_first), Some(at_second)) =
        (candidate.entry(first.0, first.1), candidate.entry(second.0, second.1))
    else {
        return;
    };
    for ((row, entry), value) in [(first, at_second), (second, at_first)] {
        if let Some(place) = candidate.entry_mut(row, entry) {
            *place = value;
        }
    }
}
