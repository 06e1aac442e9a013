//! Several faults of the joint terms at once, if the other description has the right ones: damping, dry friction and armature
//! are diagnosed one after another, each with a cause of its own. Each of them shows joint by joint, so that terms which
//! differ always have a cause.

use congruent_dynamics::{DynamicsError, JointResistance};

use super::{
    cause,
    cause_names::DynamicsCause,
    diagnose::DiagnosisInput,
    fit::{Corrected, FittedHypothesis},
    hypothesis::{Change, DynamicsHypothesis, DynamicsPlace},
    part_by_part::best_cause,
    rank::ExactExplanation,
};
use crate::{model::JointTerm, torque::states::SampledState};

/// The cause of each term if no specific cause has a residual within tolerance.
const FREE: [(DynamicsCause, JointTerm); 3] = [
    (DynamicsCause::Damping, JointTerm::Damping),
    (DynamicsCause::Friction, JointTerm::Friction),
    (DynamicsCause::Armature, JointTerm::Armature),
];

/// Causes of the joint terms that differ from the other description, each term with the ones before it right. `None` if none
/// of them has an effect on torques.
pub(crate) fn term_by_term(
    setting: &DiagnosisInput<'_>,
    right: &[JointResistance],
    states: &[SampledState],
) -> Result<Option<ExactExplanation>, DynamicsError> {
    let mut before = setting.candidate.clone();
    let mut parts = Vec::new();
    for (cause, term) in FREE {
        let mut after = before.clone();
        for (new, right) in after.resistances.iter_mut().zip(right) {
            term.set(new, term.value_in(right));
        }
        if after.resistances == before.resistances {
            continue;
        }
        let torque = setting.torque_between([&before, &after], states)?;
        let hypotheses = cause::joint_and_gravity_hypotheses(&before, setting.faulty);
        let off = values_off(cause, term, [&before.resistances, &after.resistances]);
        parts.extend(best_cause(setting, [&before, &after], &torque, &hypotheses, off));
        before = after;
    }
    Ok((!parts.is_empty()).then(|| ExactExplanation::new(parts, setting.candidate, setting.reference)))
}

/// One term has other values at some joints, as those of `after`.
fn values_off(
    cause: DynamicsCause,
    term: JointTerm,
    [before, after]: [&[JointResistance]; 2],
) -> FittedHypothesis {
    let differs = |joint: &usize| before[*joint] != after[*joint];
    let joints: Vec<usize> = (0..before.len()).filter(differs).collect();
    let groups: Vec<Vec<usize>> = joints.iter().map(|&joint| vec![joint]).collect();
    let rank = joints.len();
    let (detail, place) = match rank {
        1 => ("", DynamicsPlace::Joints(joints)),
        _ if rank < before.len() => ("each", DynamicsPlace::Joints(joints)),
        _ => ("each", DynamicsPlace::AllJoints),
    };
    FittedHypothesis {
        hypothesis: DynamicsHypothesis::new(cause, detail, place, Change::FreeJoints { term, groups }),
        corrected: Corrected { joints: Some(after.to_vec()), ..Corrected::default() },
        residual_norm: 0.0,
        rank,
    }
}
