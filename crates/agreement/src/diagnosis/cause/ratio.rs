//! `ratio`: a joint moves more or less than its variable says.

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::Parameter,
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let ratio = |row| Hypothesis::fit(Cause::Ratio, Place::Rows(vec![row]), vec![Parameter::Rate(row)]);
    (0..case.suspect.rows.len()).map(ratio).collect()
}
