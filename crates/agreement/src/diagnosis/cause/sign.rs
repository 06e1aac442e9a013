//! `parameter` and `zero_offset`: a minus that is missing or too many, at one value, at several values of a row, or at a
//! whole column. The value itself is right, so nothing is fitted.

use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

/// The values of a row that change their sign together: the lengths, and all that the link fixes.
const TOGETHER: [&[DhEntry]; 2] = [&[DhEntry::A, DhEntry::D], &[DhEntry::A, DhEntry::Alpha, DhEntry::D]];

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let rows = candidate.rows.len();
    let has_sign = |row: usize, entry: DhEntry| candidate.entry(row, entry).is_some_and(|value| value != 0.0);
    let mut list = Vec::new();
    for row in 0..rows {
        for entry in DhEntry::ALL.into_iter().filter(|&entry| has_sign(row, entry)) {
            let cause = if entry == candidate.zero_entry(row) { Cause::ZeroOffset } else { Cause::Parameter };
            list.push(turned(cause, FaultPlace::Entries(entry, vec![row]), vec![(row, entry)]));
        }
        let signed = TOGETHER.map(|entries| -> Vec<DhEntry> {
            entries.iter().copied().filter(|&entry| has_sign(row, entry)).collect()
        });
        for (at, entries) in signed.iter().enumerate() {
            // Without an alpha both lists are the same.
            if entries.len() > 1 && !signed[..at].contains(entries) {
                let values = entries.iter().map(|&entry| (row, entry)).collect();
                list.push(turned(Cause::Parameter, FaultPlace::RowEntries(entries.clone(), row), values));
            }
        }
    }
    for entry in DhEntry::ALL {
        let values: Vec<(usize, DhEntry)> =
            (0..rows).filter(|&row| has_sign(row, entry)).map(|row| (row, entry)).collect();
        if values.len() > 1 {
            list.push(turned(Cause::Parameter, FaultPlace::Column(vec![entry]), values));
        }
    }
    list
}

fn turned(cause: Cause, place: FaultPlace, values: Vec<(usize, DhEntry)>) -> PoseHypothesis {
    PoseHypothesis::edit(cause, place, move |models: &mut ModelPair| {
        for &(row, entry) in &values {
            negate(&mut models.candidate, row, entry);
        }
    })
}

fn negate(candidate: &mut CandidateModel, row: usize, entry: DhEntry) {
    if let Some(value) = candidate.entry_mut(row, entry) {
        *value = -*value;
    }
}
