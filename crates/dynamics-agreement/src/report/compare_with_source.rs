//! A description against a source of accelerations that was built from it, such as a physics engine.

use super::{
    compare_descriptions::{CompareError, check_count, check_numbers},
    content::{DynamicsPremise, DynamicsReport, Sides},
    places::Files,
    told::{NamedSide, Told},
};
use crate::{
    diagnosis::{Expected, FaultySide, Setting},
    thresholds::{Precision, STATES},
    torque::{
        compressed::Compressed,
        held_out::fit_and_hold_out,
        source::{AccelerationSource, Probing, probed},
        states::random_states,
    },
};

/// Compares a description with a source of accelerations of the same robot: what of the source would have to be other
/// for the description's torques? The source is taken to be wrong, so parameters are found there and expected in the description.
///
/// Mimic joints must be free of their masters in the source.
///
/// # Errors
/// [`CompareError`] if the source fails, or if parameters are not finite.
pub fn compare_with_source(
    candidate: &NamedSide<'_>,
    (name, source): (&str, &mut dyn AccelerationSource),
    probing: Probing,
) -> Result<DynamicsReport, CompareError> {
    check_count(candidate.side.frames.dof())?;
    check_numbers(candidate.side)?;
    let states = random_states(&candidate.side.frames, probing.seed, STATES);
    let (states, torques) = probed(candidate.side, source, states, probing.step_s)
        .map_err(|message| CompareError::Source { message })?;
    let torque = Compressed::new(candidate.side, &states, &torques)?;
    let [fit_relative, held_out] = fit_and_hold_out(candidate.side, &states, &torques)?;
    let setting = Setting {
        candidate: candidate.side,
        reference: None,
        faulty: FaultySide::Reference,
        precision: Precision::ENGINE,
        pairs: true,
    };
    let expected = Expected { states: &states, torques: &torques };
    let files = Files { found: candidate.places, expected: None };
    let told = Told::new(&setting, files, &torque, expected)?;
    Ok(DynamicsReport {
        sides: Sides {
            candidate: candidate.name.to_owned(),
            reference: name.to_owned(),
            faulty: setting.faulty,
        },
        verdict: told.verdict(),
        difference_relative: torque.relative_difference(),
        premise: DynamicsPremise { fit_relative, held_out_relative: Some(held_out), states: states.len() },
        seen: Some(torque.seen),
        invariants: None,
        links: told.links,
        differences: Vec::new(),
        hidden_differences: Vec::new(),
        explanations: told.explanations,
        indistinguishable: told.indistinguishable,
        limits: Vec::new(),
        certificates: None,
    })
}
