//! Where both sides are descriptions, the difference of each link has its own cause, whatever else differs.

use congruent_description::Elementary as _;
use congruent_dynamics::DynamicsError;

use super::{content::DynamicsExplanation, explained::Teller, places::Files, unmatched::Unmatched};
use crate::{
    diagnosis::{Exact, Expected, Grouped, Setting, diagnose_in_stages, part_by_part},
    side::Side,
    thresholds::PRICE_OF_PART,
    torque::{
        compressed::{Compressed, torques},
        states::State,
    },
};

/// The best explanation of each link, of the joints and of gravity alone, two of them as one; empty if the links by their
/// names do not make up the whole difference.
pub(super) fn link_by_link(
    setting: &Setting<'_>,
    files: Files<'_>,
    (reference, seen_as_candidate): (&Side, &Side),
    (whole_torque, states): (&Compressed, &[State]),
) -> Result<Vec<DynamicsExplanation>, DynamicsError> {
    let side = setting.candidate;
    let unmatched = Unmatched::new(side, reference);
    let (mut whole, corrected) = one_by_one(side, reference, seen_as_candidate);
    unmatched.correct(&mut whole);
    if !is_same(&whole, seen_as_candidate, setting, states)? {
        return Ok(Vec::new());
    }
    let mut explanations = unmatched.explanations(files);
    let mut causes = Vec::new();
    for (one, link) in &corrected {
        let torque = Compressed::new(side, states, &torques(one, states)?)?;
        let setting = Setting { reference: Some(one), pairs: false, ..*setting };
        match alone(&setting, (one, *link), &torque, states)? {
            Alone::Same => {}
            Alone::Unexplained => return Ok(Vec::new()),
            Alone::Explained(cause) => {
                explanations.push(Teller::new(&setting, files, &torque).explanation(&cause));
                causes.push(cause.named);
            }
        }
    }
    if let (2, [first, second]) = (explanations.len(), &causes[..]) {
        let parts = first.parts.iter().chain(&second.parts).cloned().collect();
        let both = Exact::new(parts, side, setting.reference);
        explanations = vec![Teller::new(setting, files, whole_torque).explanation(&both.alone())];
    }
    Ok(explanations)
}

/// The candidate with everything of the reference that has a name in both, and with each of it alone: gravity, the terms
/// of the joints, and every link with its number.
fn one_by_one(side: &Side, reference: &Side, seen_as_candidate: &Side) -> (Side, Vec<(Side, Option<usize>)>) {
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
    (whole, corrected)
}

/// What is to say of one link, of the joints or of gravity.
enum Alone {
    Same,
    Explained(Box<Grouped>),
    Unexplained,
}

/// The cheapest cause that names nothing that is equal: of the whole, or of a link's mass, centre of mass and inertia each.
fn alone(
    setting: &Setting<'_>,
    (one, link): (&Side, Option<usize>),
    torque: &Compressed,
    states: &[State],
) -> Result<Alone, DynamicsError> {
    let expected = torques(one, states)?;
    let found = diagnose_in_stages(setting, torque, Expected { states, torques: &expected })?;
    if found.same {
        return Ok(Alone::Same);
    }
    let by_parts = match link.and_then(|link| Some((link, one.inertials[link].as_ref()?))) {
        Some(of_link) => part_by_part(setting, of_link, states)?.map(Exact::alone),
        None => None,
    };
    let whole = found.explanations.into_iter().next();
    let best = whole.into_iter().chain(by_parts).min_by(|a, b| {
        let of = |grouped: &Grouped| (grouped.named.contradicted, grouped.named.price);
        let (a, b) = (of(a), of(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(best.map_or(Alone::Unexplained, |best| Alone::Explained(Box::new(best))))
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
    let size = torque.difference.norm().hypotenuse_with(torque.outside);
    Ok(size <= setting.precision.same * torque.torques)
}
