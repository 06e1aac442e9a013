//! `parameters_exchanged`: the values of a column are one row below or above their own, as `a` and `alpha` of a modified
//! table are in standard rows. The value that has no row is the one that the first or last row lacks, or it was lost: 0
//! takes its place, or it is fitted.

use crate::diagnosis::{
    candidate::{CandidateModel, DhEntry, ModelParameter},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis, RowShift},
};

/// The columns that are shifted alone, and those that change their row between the conventions.
const COLUMNS: [&[DhEntry]; 5] =
    [&[DhEntry::A], &[DhEntry::Alpha], &[DhEntry::D], &[DhEntry::Theta], &[DhEntry::A, DhEntry::Alpha]];

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let mut list = Vec::new();
    for entries in COLUMNS {
        for shift in [RowShift::BelongsUp, RowShift::BelongsDown] {
            if !entries.iter().all(|&entry| is_column(candidate, entry, shift)) {
                continue;
            }
            list.push(shifted(entries, shift, Freed::TakesThePlace));
            list.push(shifted(entries, shift, Freed::IsZero));
            if let [entry] = entries {
                let lost = ModelParameter::Row(lost_row(shift, candidate.rows.len()), *entry);
                list.push(PoseHypothesis { free: vec![lost], ..shifted(entries, shift, Freed::IsZero) });
            }
        }
    }
    list
}

/// Whether at least two values that are not 0 move to another row: with one alone it is that value that is wrong, or
/// exchanged with another.
fn is_column(candidate: &CandidateModel, entry: DhEntry, shift: RowShift) -> bool {
    let rows = candidate.rows.len();
    let moved_out = match shift {
        RowShift::BelongsUp => 0,
        RowShift::BelongsDown => rows.saturating_sub(1),
    };
    let is_written = |row: &usize| candidate.entry(*row, entry).is_some_and(|value| value != 0.0);
    (0..rows).filter(|row| *row != moved_out).filter(is_written).count() > 1
}

/// The value of the row that no other row's value moves to.
#[derive(Clone, Copy, PartialEq)]
enum Freed {
    /// The one that is moved out at the other end.
    TakesThePlace,
    /// 0, which data sheets have there.
    IsZero,
}

fn shifted(entries: &'static [DhEntry], shift: RowShift, freed: Freed) -> PoseHypothesis {
    let place = FaultPlace::ShiftedColumn(entries.to_vec(), shift);
    PoseHypothesis::edit(Cause::ParametersExchanged, place, move |models: &mut ModelPair| {
        for &entry in entries {
            shift_column(&mut models.candidate, entry, shift, freed);
        }
    })
}

/// The row that gets no value of another row.
fn lost_row(shift: RowShift, rows: usize) -> usize {
    match shift {
        RowShift::BelongsUp => rows - 1,
        RowShift::BelongsDown => 0,
    }
}

fn shift_column(candidate: &mut CandidateModel, entry: DhEntry, shift: RowShift, freed: Freed) {
    let rows = candidate.rows.len();
    let mut values: Vec<Option<f64>> = (0..rows).map(|row| candidate.entry(row, entry)).collect();
    match shift {
        RowShift::BelongsUp => values.rotate_left(1),
        RowShift::BelongsDown => values.rotate_right(1),
    }
    if freed == Freed::IsZero {
        values[lost_row(shift, rows)] = Some(0.0);
    }
    for (row, value) in values.into_iter().enumerate() {
        if let (Some(place), Some(value)) = (candidate.entry_mut(row, entry), value) {
            *place = value;
        }
    }
}
