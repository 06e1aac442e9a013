//! The catalogue of causes, one family a file.

mod com;
mod free_numbers;
mod gravity;
mod joint_terms;
mod missing;
mod other_frames;
pub(super) mod slip;
mod tensor;
mod two_links;
mod units;

pub(super) use self::joint_terms::all_left_out;
use self::slip::Slip;
pub(crate) use self::units::{rounded_damping_unit, rounded_unit};
use super::{
    cause_names::DynamicsCause,
    hypothesis::{Change, FaultySide, Hypothesis, Place, Scale},
};
use crate::side::{Frames, Side};

/// Slips with one link's parameters.
pub(super) fn slips(frames: &Frames, faulty: FaultySide) -> Vec<Slip<'_>> {
    let mut slips = units::slips(faulty);
    slips.extend(com::slips(faulty));
    slips.extend(other_frames::slips(frames, faulty));
    slips.extend(tensor::slips(faulty));
    if faulty == FaultySide::Reference {
        slips.extend(missing::slips_of_importers());
    }
    slips
}

/// What can be wrong at one link; a parameter that the other description has, if there is one, can be missing.
pub(super) fn of_link(
    side: &Side,
    reference: Option<&Side>,
    faulty: FaultySide,
    slips: &[Slip<'_>],
    link: usize,
) -> Vec<Hypothesis> {
    let mut hypotheses: Vec<Hypothesis> = Vec::new();
    if let Some(parameters) = &side.inertials[link] {
        for slip in slips {
            if let Some(changed) = (slip.change)(link, parameters).filter(|changed| changed != parameters) {
                let (place, change) = (Place::Links(vec![link]), Change::Links(vec![(link, changed)]));
                hypotheses.push(Hypothesis::new(slip.cause, slip.detail_at(link), place, change));
            }
        }
    }
    if faulty == FaultySide::Candidate {
        hypotheses.extend(missing::of_link(side, reference, link));
        hypotheses.extend(
            reference.and_then(|reference| other_frames::rotation_of_reference(side, reference, link)),
        );
    }
    hypotheses.extend(free_numbers::of_link(side, faulty, link));
    hypotheses
}

/// What can be wrong between two links.
pub(super) fn of_two_links(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    two_links::pairs(side, faulty)
}

/// What can be wrong at all links.
pub(super) fn of_all_links(side: &Side, slips: &[Slip<'_>]) -> Vec<Hypothesis> {
    let slips = slips.iter().filter_map(|slip| two_links::everywhere(side, slip));
    slips
        .chain(
            SCALES
                .map(|(cause, scale)| Hypothesis::new(cause, "", Place::AllLinks, Change::FreeScale(scale))),
        )
        .collect()
}

/// One factor of all links.
const SCALES: [(DynamicsCause, Scale); 3] = [
    (DynamicsCause::MassScale, Scale::Masses),
    (DynamicsCause::InertiaScale, Scale::Tensors),
    (DynamicsCause::Density, Scale::Both),
];

/// What can be wrong with joints and gravity.
pub(super) fn of_joints_and_gravity(side: &Side, faulty: FaultySide) -> Vec<Hypothesis> {
    let mut hypotheses = joint_terms::hypotheses(side, faulty);
    hypotheses.extend(gravity::hypotheses(side, faulty));
    hypotheses
}
