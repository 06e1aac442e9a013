//! `parameter`: a row is revolute although its joint is prismatic, or the reverse.

use congruent_description::DhRowKind;

use crate::diagnosis::{
    candidate::RowConstants,
    hypothesis::{Cause, FaultPlace, ModelPair, PoseHypothesis},
};

pub(in crate::diagnosis::cause) fn hypotheses(models: &ModelPair) -> Vec<PoseHypothesis> {
    let twists: Vec<_> = models.reference.joints.iter().filter_map(|joint| joint.twist_in_joint).collect();
    let other = |row: usize| {
        let RowConstants::Dh { kind, .. } = models.candidate.rows[row].link else { return None };
        let shifts = twists.get(models.candidate.rows[row].joint)?.angular.norm() == 0.0;
        let expected = if shifts { DhRowKind::Prismatic } else { DhRowKind::Revolute };
        (kind != expected).then(|| changed(row, expected))
    };
    (0..models.candidate.rows.len()).filter_map(other).collect()
}

fn changed(row: usize, expected: DhRowKind) -> PoseHypothesis {
    PoseHypothesis::edit(Cause::Parameter, FaultPlace::Rows(vec![row]), move |models: &mut ModelPair| {
        if let RowConstants::Dh { kind, .. } = &mut models.candidate.rows[row].link {
            *kind = expected;
        }
    })
}
