//! Mistakes with two links, or with all links at once.

use super::common_mistake::CommonMistake;
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
    },
    model::{DynamicsModel, Frames, Inertial},
};

/// Hypotheses about inertias that are exchanged between two links, or counted twice.
pub(super) fn pairs(model: &DynamicsModel, faulty: FaultySide) -> Vec<DynamicsHypothesis> {
    let moving: Vec<(usize, &Inertial)> = model
        .inertials
        .iter()
        .enumerate()
        .filter(|(link, _)| model.frames.links[*link].body.is_some())
        .filter_map(|(link, inertial)| Some((link, inertial.as_ref()?)))
        .collect();
    let mut hypotheses = Vec::new();
    for &(first, a) in &moving {
        for &(second, b) in &moving {
            let pair = |cause, changed| {
                DynamicsHypothesis::new(
                    cause,
                    "",
                    DynamicsPlace::Links(vec![first, second]),
                    Change::Links(changed),
                )
            };
            // An exchange is the same in both orders; what is counted twice is not.
            if first < second {
                hypotheses.push(pair(DynamicsCause::InertialsSwapped, vec![(first, *b), (second, *a)]));
                let with_mass_of =
                    |own: &Inertial, other: &Inertial| Inertial { mass_kg: other.mass_kg, ..*own };
                let swapped = vec![(first, with_mass_of(a, b)), (second, with_mass_of(b, a))];
                hypotheses.push(pair(DynamicsCause::MassesSwapped, swapped));
            }
            if first != second && carries(&model.frames, first, second) {
                let both = with_other(&model.frames, faulty, [(first, a), (second, b)]);
                hypotheses.push(pair(DynamicsCause::CountedTwice, vec![(first, both)]));
            }
        }
    }
    hypotheses
}

/// Whether the second link belongs to the body of the first, or to a body that this one carries.
fn carries(frames: &Frames, first: usize, second: usize) -> bool {
    let [holder, part] = [first, second].map(|link| frames.links[link].body);
    holder == part || part.is_some_and(|part| frames.joints[part].parent == holder)
}

/// The parameters of the first link plus (reference) or minus (candidate) those of the second, joints at zero.
fn with_other(
    frames: &Frames,
    faulty: FaultySide,
    [(first, a), (second, b)]: [(usize, &Inertial); 2],
) -> Inertial {
    let first_from_second = frames.root_from_link(first).inverse() * *frames.root_from_link(second);
    let part = b.about_origin().transformed_by(&first_from_second);
    let sign = if faulty == FaultySide::Candidate { -1.0 } else { 1.0 };
    // Added or subtracted about the origin, where the ten parameters of bodies are additive.
    let mut numbers = a.about_origin().parameters();
    numbers.iter_mut().zip(part.parameters()).for_each(|(number, part)| *number += sign * part);
    Inertial::from_origin(&congruent_dynamics::SpatialInertia::from_parameters(numbers), a.link_from_axes)
}

/// A mistake at all links that it changes; `None` if it changes fewer than two.
pub(super) fn everywhere(model: &DynamicsModel, mistake: &CommonMistake<'_>) -> Option<DynamicsHypothesis> {
    let changed: Vec<(usize, Inertial)> = (0..model.inertials.len())
        .filter(|&link| model.frames.links[link].body.is_some())
        .filter_map(|link| {
            let parameters = model.inertials[link].as_ref()?;
            Some((link, (mistake.change)(link, parameters).filter(|changed| changed != parameters)?))
        })
        .collect();
    // At one link it is that link, which is a cause of its own and more precise.
    (changed.len() > 1).then(|| {
        DynamicsHypothesis::new(
            mistake.cause,
            mistake.detail.clone(),
            DynamicsPlace::AllLinks,
            Change::Links(changed),
        )
    })
}
