//! Compares two descriptions of a chain that is too long for a diagnosis (more than 60 joints): torques and parameters are
//! compared, and no cause is searched.

use congruent_dynamics::DynamicsError;

use super::named_diagnosis::NamedModel;
use crate::{
    diagnosis::{FaultySide, ReferenceTorques},
    differences::{hidden, invariants::invariants, limits, parameters},
    model::DynamicsModel,
    report::{
        content::{ComparedModels, DynamicsPremise, DynamicsReport, DynamicsVerdict},
        places::ModelFiles,
    },
    thresholds::{INVARIANT_STATES, Precision},
    torque::reduced_difference::{torques, weights},
};

/// Compares at some states; `reference_in_candidate` is the reference expressed in the candidate's geometry, `expected` its
/// torques.
pub(super) fn compare_long(
    candidate: &NamedModel<'_>,
    reference: &NamedModel<'_>,
    reference_in_candidate: &DynamicsModel,
    joints: &[usize],
    expected: ReferenceTorques<'_>,
) -> Result<DynamicsReport, DynamicsError> {
    let (own, other, states) = (candidate.model, reference.model, expected.states);
    let difference_relative = difference_relative(expected.torques, &torques(own, states)?, own.frames.dof());
    let files = ModelFiles { found: candidate.places, expected: reference.places };
    let mut differences = hidden::differences(own, other);
    differences.extend(parameters::joint_term_differences(
        &own.frames,
        &own.resistances,
        &reference_in_candidate.resistances,
    ));
    differences.extend(parameters::gravity_differences(&own.gravity_m_s2, &other.gravity_m_s2));
    files.place(&mut differences);
    let mut limits = limits::differences(own, other, joints);
    files.place_limits(&mut limits);
    let is_same = difference_relative <= Precision::EXACT.same;
    let verdict = match (is_same, differences.is_empty()) {
        (true, true) => DynamicsVerdict::Same,
        (true, false) => DynamicsVerdict::SameTorques,
        (false, _) => DynamicsVerdict::Unexplained,
    };
    let tree = reference_in_candidate.tree().without_resistances();
    Ok(DynamicsReport {
        sides: ComparedModels {
            candidate: candidate.name.to_owned(),
            reference: reference.name.to_owned(),
            faulty: FaultySide::Candidate,
        },
        verdict,
        difference_relative,
        premise: DynamicsPremise { fit_relative: 0.0, held_out_relative: None, states: states.len() },
        seen: None,
        invariants: Some(invariants([own, other], &tree, &states[..INVARIANT_STATES])?),
        links: Vec::new(),
        hidden_differences: if is_same { differences.clone() } else { Vec::new() },
        differences,
        explanations: Vec::new(),
        indistinguishable: Vec::new(),
        not_stated: Vec::new(),
        armature_stated_by: None,
        limits,
        certificates: None,
    })
}

/// The difference of torques relative to the sum of both norms; each joint is weighted by its own torques.
fn difference_relative(expected: &[Vec<f64>], found: &[Vec<f64>], joints: usize) -> f64 {
    let weights = weights(expected, joints);
    let [mut difference, mut of_expected, mut of_found] = [0.0_f64; 3];
    for (expected, found) in expected.iter().zip(found) {
        for ((weight, expected), found) in weights.iter().zip(expected).zip(found) {
            difference += (weight * (expected - found)).powi(2);
            of_expected += (weight * expected).powi(2);
            of_found += (weight * found).powi(2);
        }
    }
    if difference > 0.0 { difference.sqrt() / (of_expected.sqrt() + of_found.sqrt()) } else { 0.0 }
}
