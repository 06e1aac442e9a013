//! The catalogue of causes, one file for each family.

mod com;
pub(super) mod common_mistake;
mod free_numbers;
mod gravity;
mod joint_terms;
mod missing;
mod other_frames;
mod tensor;
mod two_links;
mod units;

use self::common_mistake::CommonMistake;
pub(super) use self::joint_terms::all_left_out;
pub(crate) use self::units::{rounded_damping_unit, rounded_unit};
use super::{
    cause_names::DynamicsCause,
    hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide, Scale},
};
use crate::model::{DynamicsModel, Frames};

/// Mistakes with one link's parameters that have no free parameter.
pub(super) fn mistakes(frames: &Frames, faulty: FaultySide) -> Vec<CommonMistake<'_>> {
    let mut mistakes = units::mistakes(faulty);
    mistakes.extend(com::mistakes(faulty));
    mistakes.extend(other_frames::mistakes(frames, faulty));
    mistakes.extend(tensor::mistakes(faulty));
    // An importer drops values on its side; a file that lacks them is `missing::link_hypotheses`, whose values are
    // free.
    if faulty == FaultySide::Reference {
        mistakes.extend(missing::importer_mistakes());
    }
    mistakes
}

/// Hypotheses about one link; a parameter can be missing only if the other description, if there is one, has it.
pub(super) fn link_hypotheses(
    model: &DynamicsModel,
    reference: Option<&DynamicsModel>,
    faulty: FaultySide,
    mistakes: &[CommonMistake<'_>],
    link: usize,
) -> Vec<DynamicsHypothesis> {
    let mut hypotheses: Vec<DynamicsHypothesis> = Vec::new();
    if let Some(parameters) = &model.inertials[link] {
        for mistake in mistakes {
            // A mistake that has no effect on these values, as a swap of equal moments, is no hypothesis.
            if let Some(changed) = (mistake.change)(link, parameters).filter(|changed| changed != parameters)
            {
                let (place, change) =
                    (DynamicsPlace::Links(vec![link]), Change::Links(vec![(link, changed)]));
                hypotheses.push(DynamicsHypothesis::new(
                    mistake.cause,
                    mistake.detail_at(link),
                    place,
                    change,
                ));
            }
        }
    }
    if faulty == FaultySide::Candidate {
        hypotheses.extend(missing::link_hypotheses(model, reference, link));
        hypotheses.extend(reference.and_then(|reference| missing::only_here(model, reference, link)));
        hypotheses.extend(
            reference.and_then(|reference| other_frames::rotation_of_reference(model, reference, link)),
        );
    }
    hypotheses.extend(free_numbers::link_hypotheses(model, faulty, link));
    hypotheses
}

/// Hypotheses about two links.
pub(super) fn two_link_hypotheses(model: &DynamicsModel, faulty: FaultySide) -> Vec<DynamicsHypothesis> {
    two_links::pairs(model, faulty)
}

/// Hypotheses about all links at once.
pub(super) fn all_links_hypotheses(
    model: &DynamicsModel,
    mistakes: &[CommonMistake<'_>],
) -> Vec<DynamicsHypothesis> {
    let mistakes = mistakes.iter().filter_map(|mistake| two_links::everywhere(model, mistake));
    mistakes
        .chain(SCALES.map(|(cause, scale)| {
            DynamicsHypothesis::new(cause, "", DynamicsPlace::AllLinks, Change::FreeScale(scale))
        }))
        .collect()
}

/// Hypotheses with one free factor for all links.
const SCALES: [(DynamicsCause, Scale); 3] = [
    (DynamicsCause::MassScale, Scale::Masses),
    (DynamicsCause::InertiaScale, Scale::Tensors),
    (DynamicsCause::Density, Scale::Both),
];

/// Hypotheses about joint terms and gravity.
pub(super) fn joint_and_gravity_hypotheses(
    model: &DynamicsModel,
    faulty: FaultySide,
) -> Vec<DynamicsHypothesis> {
    let mut hypotheses = joint_terms::hypotheses(model, faulty);
    hypotheses.extend(gravity::hypotheses(model, faulty));
    hypotheses
}
