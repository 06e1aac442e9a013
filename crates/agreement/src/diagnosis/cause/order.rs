//! `joints_swapped`: two joints' names or whole rows are exchanged.

use crate::diagnosis::hypothesis::{Case, Cause, Hypothesis, Place};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let rows = case.suspect.rows.len();
    let pairs = (0..rows).flat_map(|second| (0..second).map(move |first| (first, second)));
    pairs.flat_map(|(first, second)| [names(first, second), whole_rows(first, second)]).collect()
}

/// The figures stand where they should, the names do not.
fn names(first: usize, second: usize) -> Hypothesis {
    Hypothesis::edit(Cause::JointsSwapped, Place::Rows(vec![first, second]), move |case: &mut Case| {
        let rows = &mut case.suspect.rows;
        (rows[first].joint, rows[second].joint) = (rows[second].joint, rows[first].joint);
    })
}

/// Names and figures have changed places together.
fn whole_rows(first: usize, second: usize) -> Hypothesis {
    Hypothesis::edit(Cause::JointsSwapped, Place::Rows(vec![first, second]), move |case: &mut Case| {
        case.suspect.rows.swap(first, second);
    })
}
