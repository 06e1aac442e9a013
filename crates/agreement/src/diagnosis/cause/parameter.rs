//! `parameter`: one entry of one row is off. The angle that the joint drives is `zero_offset`; the
//! offset that a prismatic joint drives is both.

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::{Entry, Parameter},
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let suspect = &case.suspect;
    let mut list = Vec::new();
    for row in 0..suspect.rows.len() {
        for entry in [Entry::A, Entry::Alpha, Entry::D, Entry::Theta] {
            let is_zero = entry == suspect.zero_entry(row) && entry == Entry::Theta;
            if !is_zero && suspect.entry(row, entry).is_some() {
                let place = Place::Entries(entry, vec![row]);
                list.push(Hypothesis::fit(Cause::Parameter, place, vec![Parameter::Row(row, entry)]));
            }
        }
    }
    list
}
