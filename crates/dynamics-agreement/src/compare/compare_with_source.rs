//! Compares a description with a source of accelerations that was built from it, such as a physics engine.

use super::{
    compare_descriptions::{CompareError, check_count, check_numbers},
    named_diagnosis::{NamedDiagnosis, NamedModel},
};
use crate::{
    diagnosis::{DiagnosisInput, FaultySide, ReferenceTorques},
    report::{
        content::{ComparedModels, DynamicsPremise, DynamicsReport},
        places::ModelFiles,
    },
    thresholds::{Precision, STATES},
    torque::{
        held_out::fit_and_hold_out,
        reduced_difference::ReducedTorqueDifference,
        source::{AccelerationSource, IdentificationOptions, sampled_states},
        states::random_states,
    },
};

/// Compares a description with a source of accelerations of the same robot: which parameters of the source differ from the
/// description? The source is assumed to be wrong, so `found` is its value and `expected` that of the description.
///
/// In the source, mimic joints must move independently of their masters.
///
/// # Errors
/// [`CompareError`] if the source fails, or if parameters are not finite.
pub fn compare_with_source(
    candidate: &NamedModel<'_>,
    name: &str,
    source: &mut dyn AccelerationSource,
    options: IdentificationOptions,
) -> Result<DynamicsReport, CompareError> {
    check_count(candidate.model.frames.dof())?;
    check_numbers(candidate.model)?;
    let states = random_states(&candidate.model.frames, options.seed, STATES);
    let (states, torques) = sampled_states(candidate.model, source, states, options.step_s)
        .map_err(|message| CompareError::Source { message })?;
    let torque = ReducedTorqueDifference::new(candidate.model, &states, &torques)?;
    let [fit_relative, held_out] = fit_and_hold_out(candidate.model, &states, &torques)?;
    let setting = DiagnosisInput {
        candidate: candidate.model,
        reference: None,
        faulty: FaultySide::Reference,
        precision: Precision::ENGINE,
        pairs: true,
        unstated: &[],
        known: None,
    };
    let expected = ReferenceTorques { states: &states, torques: &torques };
    let files = ModelFiles { found: candidate.places, expected: None };
    let diagnosis = NamedDiagnosis::new(&setting, files, &torque, expected)?;
    Ok(DynamicsReport {
        sides: ComparedModels {
            candidate: candidate.name.to_owned(),
            reference: name.to_owned(),
            faulty: setting.faulty,
        },
        verdict: diagnosis.verdict(),
        difference_relative: torque.relative_difference(),
        premise: DynamicsPremise { fit_relative, held_out_relative: Some(held_out), states: states.len() },
        seen: Some(torque.identifiable),
        invariants: None,
        links: diagnosis.links,
        differences: Vec::new(),
        hidden_differences: Vec::new(),
        explanations: diagnosis.explanations,
        indistinguishable: diagnosis.indistinguishable,
        not_stated: Vec::new(),
        armature_stated_by: None,
        limits: Vec::new(),
        certificates: None,
    })
}
