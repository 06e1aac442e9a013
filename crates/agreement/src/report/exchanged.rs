//! Messages about values in each other's place: two of a row, one entry of two rows, two columns, and a column that is
//! shifted by one row.

use congruent_input::fitted_number;

use super::{
    content::Fault,
    fault_message::{FaultContext, FaultMessage, row_key},
    values::ReportedValue,
};
use crate::diagnosis::{DhEntry, ModelPair, RowShift};

impl FaultContext<'_> {
    /// Two values of one row that are exchanged.
    pub(super) fn row_exchanged(&self, row: usize, entries: &[DhEntry]) -> FaultMessage {
        let (joint, found) = (self.joint(row), self.row_found(row, entries));
        let message = format!("{} of joint \"{joint}\" are exchanged: {found}", names(entries, " and "));
        let fault = self.about_row(row, entries);
        let written = entries.iter().copied().find(|&entry| self.is_written(row, row_key(entry)));
        let location = self.location(row, row_key(written.unwrap_or(entries[0])));
        FaultMessage { fault, message, location }
    }

    /// The given values of a row, as they are written.
    pub(super) fn row_found(&self, row: usize, entries: &[DhEntry]) -> String {
        let value = |entry| self.before.candidate.entry(row, entry).unwrap_or_default();
        entries.iter().map(|&entry| self.given(row, entry, value(entry))).collect::<Vec<_>>().join(", ")
    }

    /// A fault of several values of a row, with those that are found and those that are expected.
    pub(super) fn about_row(&self, row: usize, entries: &[DhEntry]) -> Fault {
        let value = |entry| self.after.candidate.entry(row, entry).unwrap_or_default();
        let expected: Vec<String> =
            entries.iter().map(|&entry| self.written(row, entry, value(entry))).collect();
        Fault {
            joint: Some(self.joint(row)),
            parameter: Some(names(entries, ", ")),
            found: Some(ReportedValue::Text(self.row_found(row, entries))),
            suggestion: expected.join("\n"),
            expected: Some(ReportedValue::Text(expected.join(", "))),
            ..Fault::default()
        }
    }

    /// The values of one entry in two rows that are exchanged.
    pub(super) fn values_exchanged(&self, entry: DhEntry, rows: [usize; 2]) -> FaultMessage {
        let joints = rows.map(|row| self.joint(row)).to_vec();
        let message = format!("{entry} of joints \"{}\" are exchanged", joints.join("\", \""));
        let expected = |row| self.after.candidate.entry(row, entry).unwrap_or_default();
        let suggestion = rows.map(|row| self.written(row, entry, expected(row))).join("\n");
        let fault = Fault { joints, parameter: Some(entry.to_string()), suggestion, ..Fault::default() };
        FaultMessage { fault, message, location: self.location(rows[1], row_key(entry)) }
    }

    /// Two columns that are exchanged in every row.
    pub(super) fn columns_exchanged(&self, entries: &[DhEntry]) -> FaultMessage {
        let names = names(entries, " and ");
        let message = format!("columns {names} are exchanged throughout the table");
        let fault = Fault { suggestion: format!("exchange {names} in every row"), ..Fault::default() };
        self.about_columns(entries, fault, message)
    }

    /// Columns whose values are one row below or above their own.
    pub(super) fn shifted(&self, entries: &[DhEntry], shift: RowShift) -> FaultMessage {
        let (off, back) = match shift {
            RowShift::BelongsUp => ("low", "up"),
            RowShift::BelongsDown => ("high", "down"),
        };
        let names = names(entries, " and ");
        let columns = if entries.len() == 1 { "column" } else { "columns" };
        let message = format!("{columns} {names} shifted: each value is one row too {off}");
        let suggestion = format!("move each value of {names} one row {back}");
        self.about_columns(entries, Fault { suggestion, ..Fault::default() }, message)
    }

    /// A fault of whole columns, at the first value that differs.
    pub(super) fn about_columns(&self, entries: &[DhEntry], fault: Fault, message: String) -> FaultMessage {
        let rows = 0..self.before.candidate.rows.len();
        let value = |models: &ModelPair, row| models.candidate.entry(row, entries[0]);
        let differs = |row: &usize| value(self.before, *row) != value(self.after, *row);
        let row = rows.clone().find(differs).unwrap_or(0);
        let column = |models: &ModelPair, entry: DhEntry| {
            let values = rows.clone().map(|row| models.candidate.entry(row, entry).unwrap_or_default());
            format!("{entry} = [{}]", values.map(fitted_number).collect::<Vec<_>>().join(", "))
        };
        let columns = |models: &ModelPair| {
            let columns: Vec<String> = entries.iter().map(|&entry| column(models, entry)).collect();
            Some(ReportedValue::Text(columns.join(", ")))
        };
        let fault = Fault {
            parameter: Some(names(entries, ", ")),
            found: columns(self.before),
            expected: columns(self.after),
            ..fault
        };
        FaultMessage { fault, message, location: self.location(row, row_key(entries[0])) }
    }
}

/// The symbols of entries.
pub(super) fn names(entries: &[DhEntry], between: &str) -> String {
    entries.iter().map(DhEntry::to_string).collect::<Vec<_>>().join(between)
}
