//! Messages about a wrong sign of several values: of a row, or of a column.

use super::{
    content::Fault,
    exchanged::names,
    fault_message::{FaultContext, FaultMessage, row_key},
    values::ReportedValue,
};
use crate::diagnosis::{DhEntry, ModelPair};

impl FaultContext<'_> {
    /// Several values of a row with the opposite sign.
    pub(super) fn row_signs(&self, row: usize, entries: &[DhEntry]) -> FaultMessage {
        let value = |models: &ModelPair, entry| models.candidate.entry(row, entry).unwrap_or_default();
        let both = |values: Vec<String>| ReportedValue::Text(values.join(", "));
        let found: Vec<String> =
            entries.iter().map(|&entry| self.given(row, entry, value(self.before, entry))).collect();
        let expected: Vec<String> =
            entries.iter().map(|&entry| self.written(row, entry, value(self.after, entry))).collect();
        let (joint, names) = (self.joint(row), names(entries, ", "));
        let message = format!("joint \"{joint}\": {}, expected the opposite signs", found.join(", "));
        let fault = Fault {
            joint: Some(joint),
            parameter: Some(names),
            found: Some(both(found)),
            suggestion: expected.join("\n"),
            expected: Some(both(expected)),
            ..Fault::default()
        };
        FaultMessage { fault, message, location: self.location(row, row_key(entries[0])) }
    }

    /// A column whose values all have the opposite sign.
    pub(super) fn column_signs(&self, entries: &[DhEntry]) -> FaultMessage {
        let names = names(entries, " and ");
        let message = format!("all values of {names} in the table have the opposite sign");
        let fault =
            Fault { suggestion: format!("change the sign of {names} in every row"), ..Fault::default() };
        self.about_columns(entries, fault, message)
    }
}
