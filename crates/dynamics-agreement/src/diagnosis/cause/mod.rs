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

use self::slip::Slip;
use super::hypothesis::{Change, Hypothesis, Place, Suspect};
use crate::side::{Frames, Side};

/// Slips with one link's figures.
pub(super) fn slips(frames: &Frames, suspect: Suspect) -> Vec<Slip<'_>> {
    let mut slips = units::slips(suspect);
    slips.extend(com::slips(suspect));
    slips.extend(other_frames::slips(frames, suspect));
    slips.extend(tensor::slips(suspect));
    if suspect == Suspect::Reference {
        slips.extend(missing::slips_of_importers());
    }
    slips
}

/// What can be wrong at one link.
pub(super) fn of_link(side: &Side, suspect: Suspect, slips: &[Slip<'_>], link: usize) -> Vec<Hypothesis> {
    let mut hypotheses: Vec<Hypothesis> = Vec::new();
    if let Some(figures) = &side.inertials[link] {
        for slip in slips {
            if let Some(changed) = (slip.change)(link, figures).filter(|changed| changed != figures) {
                let (place, change) = (Place::Links(vec![link]), Change::Links(vec![(link, changed)]));
                hypotheses.push(Hypothesis::new(slip.cause, slip.detail.clone(), place, change));
            }
        }
    }
    if suspect == Suspect::Candidate {
        hypotheses.extend(missing::of_link(side, link));
    }
    hypotheses.extend(free_numbers::of_link(side, suspect, link));
    hypotheses
}

/// What can be wrong between two links.
pub(super) fn of_two_links(side: &Side, suspect: Suspect) -> Vec<Hypothesis> {
    two_links::pairs(side, suspect)
}

/// What can be wrong at all links.
pub(super) fn of_all_links(side: &Side, slips: &[Slip<'_>]) -> Vec<Hypothesis> {
    slips.iter().filter_map(|slip| two_links::everywhere(side, slip)).collect()
}

/// What can be wrong with joints and gravity.
pub(super) fn of_joints_and_gravity(side: &Side, suspect: Suspect) -> Vec<Hypothesis> {
    let mut hypotheses = joint_terms::hypotheses(side, suspect);
    hypotheses.extend(gravity::hypotheses(side, suspect));
    hypotheses
}
