//! `parameter`: one entry of one row is off. The entry that the joint drives is `zero_offset`.

use crate::agreement::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::{Entry, Parameter},
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let suspect = &case.suspect;
    let mut list = Vec::new();
    for row in 0..suspect.rows.len() {
        for entry in [Entry::A, Entry::Alpha, Entry::D, Entry::Theta] {
            if entry != suspect.zero_entry(row) && suspect.entry(row, entry).is_some() {
                let place = Place::Entries(entry, vec![row]);
                list.push(Hypothesis::fit(Cause::Parameter, place, vec![Parameter::Row(row, entry)]));
            }
        }
    }
    list
}
