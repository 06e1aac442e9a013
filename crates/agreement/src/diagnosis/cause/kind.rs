//! `parameter`: a row says that its joint turns where it shifts, or the reverse.

use congruent_description::DhRowKind;

use crate::diagnosis::{
    hypothesis::{Case, Cause, Hypothesis, Place},
    suspect::SuspectLink,
};

pub(super) fn hypotheses(case: &Case) -> Vec<Hypothesis> {
    let twists: Vec<_> = case.reference.joints.iter().filter_map(|joint| joint.twist_in_joint).collect();
    let other = |row: usize| {
        let SuspectLink::Dh { kind, .. } = case.suspect.rows[row].link else { return None };
        let shifts = twists.get(case.suspect.rows[row].joint)?.angular.norm() == 0.0;
        let expected = if shifts { DhRowKind::Prismatic } else { DhRowKind::Revolute };
        (kind != expected).then(|| changed(row, expected))
    };
    (0..case.suspect.rows.len()).filter_map(other).collect()
}

fn changed(row: usize, expected: DhRowKind) -> Hypothesis {
    Hypothesis::edit(Cause::Parameter, Place::Rows(vec![row]), move |case: &mut Case| {
        if let SuspectLink::Dh { kind, .. } = &mut case.suspect.rows[row].link {
            *kind = expected;
        }
    })
}
