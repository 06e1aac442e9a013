//! `parameter`: one entry of one row is wrong. The angle that a revolute joint drives is `zero_offset`
//! instead; the offset that a prismatic joint drives is both.

use crate::diagnosis::{
    candidate::{DhEntry, ModelParameter},
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(super) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let candidate = &models.candidate;
    let mut list = Vec::new();
    for row in 0..candidate.rows.len() {
        for entry in [DhEntry::A, DhEntry::Alpha, DhEntry::D, DhEntry::Theta] {
            // A prismatic joint's `d` stays in this list as well: a wrong length and a shifted zero look the same
            // in it.
            let is_zero = entry == candidate.zero_entry(row) && entry == DhEntry::Theta;
            if !is_zero && candidate.entry(row, entry).is_some() {
                let place = FaultPlace::Entries(entry, vec![row]);
                list.push(PoseHypothesis::fit(
                    Cause::Parameter,
                    place,
                    vec![ModelParameter::Row(row, entry)],
                ));
            }
        }
    }
    list
}
