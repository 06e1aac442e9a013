//! More faults than two at once: where both sides are descriptions, the difference of each link has its own cause.

use congruent_dynamics::DynamicsError;

use super::{content::DynamicsExplanation, places::Files, told::Told};
use crate::{
    diagnosis::{Expected, Setting},
    side::Side,
    torque::{
        compressed::{Compressed, torques},
        states::State,
    },
};

/// The best explanation of each link, of the joints and of gravity alone; empty if the links of the same names do not
/// make up the whole difference.
pub(super) fn link_by_link(
    setting: &Setting<'_>,
    files: Files<'_>,
    (reference, seen_as_candidate): (&Side, &Side),
    states: &[State],
) -> Result<Vec<DynamicsExplanation>, DynamicsError> {
    let side = setting.candidate;
    let mut whole = Side { gravity_m_s2: seen_as_candidate.gravity_m_s2, ..side.clone() };
    whole.resistances.clone_from(&seen_as_candidate.resistances);
    let mut corrected = vec![Side { gravity_m_s2: whole.gravity_m_s2, ..side.clone() }];
    corrected.push(Side { resistances: whole.resistances.clone(), ..side.clone() });
    for (link, place) in side.frames.links.iter().enumerate() {
        let Some(other) = reference.frames.find_link(&place.name) else { continue };
        if reference.inertials[other] != side.inertials[link] {
            whole.inertials[link] = reference.inertials[other];
            let mut one = side.clone();
            one.inertials[link] = reference.inertials[other];
            corrected.push(one);
        }
    }
    if !is_same(&whole, seen_as_candidate, setting, states)? {
        return Ok(Vec::new());
    }
    let mut explanations = Vec::new();
    for one in &corrected {
        let expected = torques(one, states)?;
        let torque = Compressed::new(side, states, &expected)?;
        let setting = Setting { reference: Some(one), ..*setting };
        let told = Told::new(&setting, files, &torque, Expected { states, torques: &expected })?;
        if told.explanations.is_empty() && !told.same {
            return Ok(Vec::new());
        }
        explanations.extend(told.explanations);
    }
    Ok(explanations)
}

/// Whether two sides have the same torques.
fn is_same(a: &Side, b: &Side, setting: &Setting<'_>, states: &[State]) -> Result<bool, DynamicsError> {
    let torque = Compressed::new(a, states, &torques(b, states)?)?;
    let size = torque.difference.norm().hypot(torque.outside);
    Ok(size <= setting.precision.same * torque.torques)
}
