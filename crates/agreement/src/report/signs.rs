//! Messages about a wrong sign of several values: of a row, or of a column.

use super::{
    content::Fault,
    exchanged::names,
    fault_message::{FaultContext, FaultMessage, row_key},
};
use crate::diagnosis::DhEntry;

impl FaultContext<'_> {
    /// Several values of a row with the opposite sign.
    pub(super) fn row_signs(&self, row: usize, entries: &[DhEntry]) -> FaultMessage {
        let (joint, found) = (self.joint(row), self.row_found(row, entries));
        let message = format!("joint \"{joint}\": {found}, expected the opposite signs");
        FaultMessage {
            fault: self.about_row(row, entries),
            message,
            location: self.location(row, row_key(entries[0])),
        }
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
