//! Slips between two links, or at all links at once.

use super::slip::Slip;
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        hypothesis::{Change, FaultySide, Hypothesis, Place},
    },
    side::{Frames, Inertial, Side},
};

/// Exchanged and doubled inertias.
pub(super) fn pairs(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    let moving: Vec<(usize, &Inertial)> = side
        .inertials
        .iter()
        .enumerate()
        .filter(|(link, _)| side.frames.links[*link].body.is_some())
        .filter_map(|(link, inertial)| Some((link, inertial.as_ref()?)))
        .collect();
    let mut hypotheses = Vec::new();
    for &(first, a) in &moving {
        for &(second, b) in &moving {
            let pair = |cause, changed| {
                Hypothesis::new(cause, "", Place::Links(vec![first, second]), Change::Links(changed))
            };
            if first < second {
                hypotheses.push(pair(DynamicsCause::InertialsSwapped, vec![(first, *b), (second, *a)]));
            }
            if first != second && carries(&side.frames, first, second) {
                let both = with_other(&side.frames, faulty, [(first, a), (second, b)]);
                hypotheses.push(pair(DynamicsCause::CountedTwice, vec![(first, both)]));
            }
        }
    }
    hypotheses
}

/// Whether a link is of the body that carries another one, or of the same.
fn carries(frames: &Frames, first: usize, second: usize) -> bool {
    let [holder, part] = [first, second].map(|link| frames.links[link].body);
    holder == part || part.is_some_and(|part| frames.joints[part].parent == holder)
}

/// The parameters of the first link with those of the second at joints zero put to them, or taken from them.
fn with_other(
    frames: &Frames,
    faulty: FaultySide,
    [(first, a), (second, b)]: [(usize, &Inertial); 2],
) -> Inertial {
    let first_from_second = frames.root_from_link(first).inverse() * *frames.root_from_link(second);
    let part = b.about_origin().transformed_by(&first_from_second);
    let sign = if faulty == FaultySide::Candidate { -1.0 } else { 1.0 };
    let mut numbers = a.about_origin().parameters();
    numbers.iter_mut().zip(part.parameters()).for_each(|(number, part)| *number += sign * part);
    Inertial::from_origin(&congruent_dynamics::SpatialInertia::from_parameters(numbers), a.link_from_axes)
}

/// A slip at all links that it changes, if these are several.
pub(super) fn everywhere(side: &Side, slip: &Slip<'_>) -> Option<Hypothesis> {
    let changed: Vec<(usize, Inertial)> = (0..side.inertials.len())
        .filter(|&link| side.frames.links[link].body.is_some())
        .filter_map(|link| {
            let parameters = side.inertials[link].as_ref()?;
            Some((link, (slip.change)(link, parameters).filter(|changed| changed != parameters)?))
        })
        .collect();
    (changed.len() > 1)
        .then(|| Hypothesis::new(slip.cause, slip.detail.clone(), Place::AllLinks, Change::Links(changed)))
}
