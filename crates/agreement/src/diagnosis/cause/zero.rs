//! `zero_offset`: a joint's zero is elsewhere than the model says.

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::Parameter,
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let suspect = &case.suspect;
    let zero = |row: usize| {
        let entry = suspect.zero_entry(row);
        let place = Place::Entries(entry, vec![row]);
        suspect.entry(row, entry)?;
        Some(Hypothesis::fit(Cause::ZeroOffset, place, vec![Parameter::Row(row, entry)]))
    };
    (0..suspect.rows.len()).filter_map(zero).collect()
}
