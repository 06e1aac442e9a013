//! Messages about whole columns in a wrong unit.

use congruent_input::{WrongUnit, fitted_number};

use super::{
    content::Fault,
    fault_message::{FaultContext, FaultMessage, row_key},
    values::ReportedValue,
};
use crate::diagnosis::{DhEntry, FaultPlace, ModelPair};

impl FaultContext<'_> {
    /// Columns whose values are not in the unit of their keys.
    pub(super) fn columns(&self, entries: &[DhEntry]) -> FaultMessage {
        let rows = 0..self.before.candidate.rows.len();
        let value = |models: &ModelPair, row, entry| models.candidate.entry(row, entry).unwrap_or_default();
        let differs = |&(row, entry): &(usize, DhEntry)| {
            (value(self.before, row, entry) - value(self.after, row, entry)).abs() > 0.0
        };
        let places = rows.clone().flat_map(|row| entries.iter().map(move |&entry| (row, entry)));
        // If no row changes, only the declared transforms have the wrong unit.
        let (row, entry) = places.clone().find(differs).unwrap_or((0, entries[0]));
        let factor = value(self.before, row, entry) / value(self.after, row, entry);
        let column = |models: &ModelPair, entry: DhEntry| {
            let values: Vec<String> =
                rows.clone().map(|row| fitted_number(value(models, row, entry))).collect();
            format!("{} = [{}]", entry, values.join(", "))
        };
        let table = |models: &ModelPair| {
            let columns: Vec<String> = entries.iter().map(|&entry| column(models, entry)).collect();
            Some(ReportedValue::Text(columns.join(", ")))
        };
        // A model in screws has no rows: then the declared transforms show in which direction the unit is wrong.
        let is_too_large = if factor.is_nan() { self.is_declared_too_large() } else { factor > 1.0 };
        let wrong_unit = WrongUnit { is_angle: entry.is_angle(), is_too_large };
        let names = entries.iter().map(DhEntry::to_string).collect::<Vec<_>>().join(" and ");
        let is_table = self.before.candidate.convention.is_some();
        let also = if self.fault.place == FaultPlace::Model { " and of the declared transforms" } else { "" };
        let (message, suggestion) = if is_table {
            let place = self.names.places.and_then(|places| places.value(row, row_key(entry)));
            let wrong = wrong_unit.under(place.map(|place| place.units), "their keys say");
            let right = wrong_unit.right();
            (
                format!("all values of {names} in the table{also} are {wrong}"),
                format!("write {names} in {right}, or change the keys"),
            )
        } else {
            let [unit, right] = [wrong_unit.given(), wrong_unit.right()];
            (
                format!("all lengths of the chain are in {unit} instead of {right}"),
                format!("write all lengths in {right}"),
            )
        };
        let fault = Fault {
            parameter: Some(names.replace(" and ", ", ")),
            value: factor.is_finite().then_some(factor),
            found: table(self.before),
            expected: table(self.after),
            suggestion,
            ..Fault::default()
        };
        FaultMessage { fault, message, location: self.location(row, row_key(entry)) }
    }

    /// Whether the declared transforms are longer than they should be.
    fn is_declared_too_large(&self) -> bool {
        let length_m = |models: &ModelPair| {
            let lengths = [&models.candidate.base, &models.candidate.tool];
            lengths.iter().map(|declared| declared.pose.translation.norm()).sum::<f64>()
        };
        length_m(self.before) > length_m(self.after)
    }
}
