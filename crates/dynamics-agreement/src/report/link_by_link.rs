//! Where both sides are descriptions, the difference of each link has its own cause, whatever else differs.

use congruent_dynamics::DynamicsError;

use super::{
    content::DynamicsExplanation, explained::Teller, places::Files, told::Told, unmatched::Unmatched,
};
use crate::{
    diagnosis::{Expected, Setting, part_by_part},
    side::Side,
    thresholds::PRICE_OF_PART,
    torque::{
        compressed::{Compressed, torques},
        states::State,
    },
};

/// The best explanation of each link, of the joints and of gravity alone; empty if the links by their names do not make
/// up the whole difference.
pub(super) fn link_by_link(
    setting: &Setting<'_>,
    files: Files<'_>,
    (reference, seen_as_candidate): (&Side, &Side),
    states: &[State],
) -> Result<Vec<DynamicsExplanation>, DynamicsError> {
    let side = setting.candidate;
    let mut whole = Side { gravity_m_s2: seen_as_candidate.gravity_m_s2, ..side.clone() };
    whole.resistances.clone_from(&seen_as_candidate.resistances);
    let mut corrected = vec![
        (Side { gravity_m_s2: whole.gravity_m_s2, ..side.clone() }, None),
        (Side { resistances: whole.resistances.clone(), ..side.clone() }, None),
    ];
    for (link, place) in side.frames.links.iter().enumerate() {
        let Some(other) = reference.frames.find_link(&place.name) else { continue };
        if reference.inertials[other] != side.inertials[link] {
            whole.inertials[link] = reference.inertials[other];
            let mut one = side.clone();
            one.inertials[link] = reference.inertials[other];
            corrected.push((one, Some(link)));
        }
    }
    let unmatched = Unmatched::new(side, reference);
    unmatched.correct(&mut whole);
    if !is_same(&whole, seen_as_candidate, setting, states)? {
        return Ok(Vec::new());
    }
    let mut explanations = unmatched.explanations(files);
    for (one, link) in &corrected {
        let expected = torques(one, states)?;
        let torque = Compressed::new(side, states, &expected)?;
        let setting = Setting { reference: Some(one), pairs: false, ..*setting };
        let told = Told::new(&setting, files, &torque, Expected { states, torques: &expected })?;
        if told.same {
            continue;
        }
        let by_parts = match link.and_then(|link| Some((link, one.inertials[link].as_ref()?))) {
            Some(of_link) => part_by_part(&setting, of_link, states)?,
            None => None,
        };
        let by_parts =
            by_parts.map(|exact| Teller::new(&setting, files, &torque).explanation(&exact.alone()));
        let best = told
            .explanations
            .into_iter()
            .chain(by_parts)
            .min_by(|a, b| a.contradicted.cmp(&b.contradicted).then(a.numbers.total_cmp(&b.numbers)));
        let Some(best) = best else { return Ok(Vec::new()) };
        explanations.push(best);
    }
    Ok(explanations)
}

/// Whether an account link by link is simpler than the first explanation by torques: it costs less, or the other names
/// what is the same in both files.
pub(super) fn is_simpler(by_link: &[DynamicsExplanation], by_torque: &[DynamicsExplanation]) -> bool {
    let Some(first) = by_torque.first() else { return true };
    let parts = f64::from(u32::try_from(by_link.len().saturating_sub(1)).unwrap_or(u32::MAX));
    let price = by_link.iter().map(|explanation| explanation.numbers).sum::<f64>() + parts * PRICE_OF_PART;
    !by_link.is_empty() && (first.contradicted || price < first.numbers)
}

/// Whether two sides have the same torques.
fn is_same(a: &Side, b: &Side, setting: &Setting<'_>, states: &[State]) -> Result<bool, DynamicsError> {
    let torque = Compressed::new(a, states, &torques(b, states)?)?;
    let size = torque.difference.norm().hypot(torque.outside);
    Ok(size <= setting.precision.same * torque.torques)
}
