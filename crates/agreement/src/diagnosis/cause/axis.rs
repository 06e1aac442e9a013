//! `axis_flipped`: a joint moves the other way.

use crate::diagnosis::hypothesis::{Case, Cause, Hypothesis, Place};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let flipped = |row: usize| {
        Hypothesis::edit(Cause::AxisFlipped, Place::Rows(vec![row]), move |case: &mut Case| {
            case.suspect.rows[row].rate *= -1.0;
        })
    };
    (0..case.suspect.rows.len()).map(flipped).collect()
}
