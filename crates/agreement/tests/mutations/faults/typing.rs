//! Mistakes of a person who types a table: a minus that is missing or too many, transposed digits, a column that is one
//! row too low or too high, and angles of a row in each other's place.

use congruent_agreement::diagnosis::{Cause, DhEntry, FaultPlace, ModelPair, RowShift};

use super::{InjectedFault, entry};

const ENTRIES: [DhEntry; 4] = [DhEntry::A, DhEntry::Alpha, DhEntry::D, DhEntry::Theta];

pub(super) fn all(models: &ModelPair, list: &mut Vec<InjectedFault>) {
    let rows = models.candidate.rows.len();
    for row in 0..rows {
        signs(models, row, list);
        for what in [DhEntry::A, DhEntry::D] {
            let cause =
                if what == models.candidate.zero_entry(row) { Cause::ZeroOffset } else { Cause::Parameter };
            let place = FaultPlace::Entries(what, vec![row]);
            list.push(InjectedFault::new(cause, place, move |models| {
                let value = entry(models, row, what);
                *value = transposed(*value);
            }));
        }
        let angles = vec![DhEntry::Alpha, DhEntry::Theta];
        let place = FaultPlace::RowEntries(angles, row);
        list.push(InjectedFault::new(Cause::ParametersExchanged, place, move |models| {
            let (alpha, theta) = (*entry(models, row, DhEntry::Alpha), *entry(models, row, DhEntry::Theta));
            (*entry(models, row, DhEntry::Alpha), *entry(models, row, DhEntry::Theta)) = (theta, alpha);
        }));
    }
    // With fewer values a column is no other fault than one of them.
    let is_column = |what: &DhEntry| {
        let values = (0..rows).filter_map(|row| models.candidate.entry(row, *what));
        values.filter(|value| *value != 0.0).count() > 2
    };
    let columns: Vec<DhEntry> = ENTRIES.into_iter().filter(is_column).collect();
    for &what in &columns {
        shifts(&[what], list);
    }
    if columns.starts_with(&[DhEntry::A, DhEntry::Alpha]) {
        shifts(&[DhEntry::A, DhEntry::Alpha], list);
    }
    for what in columns {
        list.push(InjectedFault::new(Cause::Parameter, FaultPlace::Column(vec![what]), move |models| {
            for row in 0..models.candidate.rows.len() {
                *entry(models, row, what) *= -1.0;
            }
        }));
    }
}

/// The first two digits after the decimal point of a length in millimetres, in each other's place: 342.5 and 324.5.
fn transposed(value_m: f64) -> f64 {
    let tenths = (value_m * 1e4).round();
    let (tens, ones) = ((tenths / 100.0).trunc() % 10.0, (tenths / 10.0).trunc() % 10.0);
    value_m + 9.0 * (ones - tens) * 1e-3
}

fn signs(models: &ModelPair, row: usize, list: &mut Vec<InjectedFault>) {
    for what in ENTRIES {
        let cause =
            if what == models.candidate.zero_entry(row) { Cause::ZeroOffset } else { Cause::Parameter };
        list.push(InjectedFault::new(cause, FaultPlace::Entries(what, vec![row]), move |models| {
            *entry(models, row, what) *= -1.0;
        }));
    }
    let is_written = |what: &DhEntry| models.candidate.entry(row, *what) != Some(0.0);
    for together in [vec![DhEntry::A, DhEntry::D], vec![DhEntry::A, DhEntry::Alpha, DhEntry::D]] {
        let signed: Vec<DhEntry> = together.into_iter().filter(is_written).collect();
        // One alone is the fault of that value.
        if signed.len() > 1 {
            let place = FaultPlace::RowEntries(signed.clone(), row);
            list.push(InjectedFault::new(Cause::Parameter, place, move |models| {
                for &what in &signed {
                    *entry(models, row, what) *= -1.0;
                }
            }));
        }
    }
}

/// Columns one row too low and too high: the value at the end is written at the other end, or 0 is.
fn shifts(columns: &[DhEntry], list: &mut Vec<InjectedFault>) {
    for shift in [RowShift::BelongsUp, RowShift::BelongsDown] {
        // Of two columns the values that are lost are too many to be found again.
        for lost in [None, Some(0.0)].into_iter().take(if columns.len() > 1 { 1 } else { 2 }) {
            let place = FaultPlace::ShiftedColumn(columns.to_vec(), shift);
            let columns = columns.to_vec();
            list.push(InjectedFault::new(Cause::ParametersExchanged, place, move |models| {
                for &what in &columns {
                    shift_column(models, what, shift, lost);
                }
            }));
        }
    }
}

fn shift_column(models: &mut ModelPair, what: DhEntry, shift: RowShift, lost: Option<f64>) {
    let rows = models.candidate.rows.len();
    let values: Vec<f64> = (0..rows).map(|row| *entry(models, row, what)).collect();
    let (end, by) = if shift == RowShift::BelongsUp { (0, rows - 1) } else { (rows - 1, 1) };
    for row in 0..rows {
        let moved = values[(row + by) % rows];
        *entry(models, row, what) = if row == end { lost.unwrap_or(moved) } else { moved };
    }
}
