//! A unit slip of whole columns in words.

use congruent_description::fitted_number;

use super::{
    blame::{Said, Witness, entry_name, is_angle, row_key},
    figures::Figure,
    ladder_report::Blame,
};
use crate::diagnosis::{Case, Entry, Place};

impl Witness<'_> {
    /// Columns whose figures are in another unit than their keys say.
    pub(super) fn columns(&self, entries: &[Entry]) -> Said {
        let rows = 0..self.before.suspect.rows.len();
        let value = |case: &Case, row, entry| case.suspect.entry(row, entry).unwrap_or_default();
        let differs = |&(row, entry): &(usize, Entry)| {
            (value(self.before, row, entry) - value(self.after, row, entry)).abs() > 0.0
        };
        let places = rows.clone().flat_map(|row| entries.iter().map(move |&entry| (row, entry)));
        // A slip that changes no row is one of the declared transforms.
        let (row, entry) = places.clone().find(differs).unwrap_or((0, entries[0]));
        let factor = value(self.before, row, entry) / value(self.after, row, entry);
        let column = |case: &Case, entry: Entry| {
            let figures: Vec<String> =
                rows.clone().map(|row| fitted_number(value(case, row, entry))).collect();
            format!("{} = [{}]", entry_name(entry), figures.join(", "))
        };
        let table = |case: &Case| {
            let columns: Vec<String> = entries.iter().map(|&entry| column(case, entry)).collect();
            Some(Figure::Text(columns.join(", ")))
        };
        let (unit, key) = match (is_angle(entry), factor > 1.0) {
            (true, true) => ("degrees", "deg"),
            (true, false) => ("radians", "rad"),
            (false, true) => ("millimetres", "mm"),
            (false, false) => ("metres", "m"),
        };
        let joined = |name: fn(Entry) -> String| {
            entries.iter().map(|&entry| name(entry)).collect::<Vec<_>>().join(" and ")
        };
        let names = joined(|entry| entry_name(entry).to_owned());
        let keys = joined(|entry| format!("{}_*", entry_name(entry))).replace('*', key);
        let (also, of_constants) = if self.part.place == Place::Model {
            (" and of the declared transforms", format!(", xyz under xyz_{key}"))
        } else {
            ("", String::new())
        };
        let blame = Blame {
            parameter: Some(names.replace(" and ", ", ")),
            value: factor.is_finite().then_some(factor),
            found: table(self.before),
            expected: table(self.after),
            suggestion: format!("the figures are {unit}: write them under {keys}{of_constants}"),
            ..Blame::default()
        };
        let message = format!("{names} of the whole table{also} are {unit}, which their keys do not say");
        (blame, message, self.spot(row, row_key(entry)))
    }
}
