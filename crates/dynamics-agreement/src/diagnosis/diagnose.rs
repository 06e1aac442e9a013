//! Finds the explanations of a torque difference and orders them.

use congruent_dynamics::DynamicsError;

use super::{
    fit::Target,
    hypothesis::FaultySide,
    rank::ExactExplanation,
    reason::EquivalenceReason,
    search::{Catalogue, RobotPart},
};
use crate::{
    model::DynamicsModel,
    thresholds::{PAIRS_ABOVE, Precision},
    torque::{
        reduced_difference::{ReducedTorqueDifference, torques},
        states::SampledState,
    },
};

/// The input of a diagnosis: both models, which one is assumed to be wrong, and the precision.
#[derive(Clone, Copy)]
pub(crate) struct DiagnosisInput<'a> {
    pub(crate) candidate: &'a DynamicsModel,
    /// The other description, if there is one: explanations that change a parameter which is equal in both come last.
    pub(crate) reference: Option<&'a DynamicsModel>,
    pub(crate) faulty: FaultySide,
    pub(crate) precision: Precision,
    /// Whether pairs of faults at two places are searched for.
    pub(crate) pairs: bool,
    /// Bodies whose masses the reference does not state: whatever they can add to the torques is no difference.
    pub(crate) unstated: &'a [usize],
    /// A difference of the candidate from another model, of which that of two others follows by their parameters.
    pub(crate) known: Option<&'a ReducedTorqueDifference>,
}

impl<'a> DiagnosisInput<'a> {
    /// Of two descriptions, of which the second is the reference.
    pub(crate) fn of_files([candidate, reference]: [&'a DynamicsModel; 2], unstated: &'a [usize]) -> Self {
        let (faulty, precision) = (FaultySide::Candidate, Precision::EXACT);
        Self { candidate, reference: Some(reference), faulty, precision, pairs: false, unstated, known: None }
    }

    /// The torque difference of a model in the candidate's frames, without what the reference does not state.
    pub(crate) fn torque_difference(
        &self,
        model: &DynamicsModel,
        expected: ReferenceTorques<'_>,
    ) -> Result<ReducedTorqueDifference, DynamicsError> {
        let torque = ReducedTorqueDifference::new(model, expected.states, expected.torques)?;
        Ok(torque.without_bodies(&model.frames, self.unstated))
    }

    /// The same of two models in the candidate's frames.
    pub(crate) fn torque_between(
        &self,
        [model, right]: [&DynamicsModel; 2],
        states: &[SampledState],
    ) -> Result<ReducedTorqueDifference, DynamicsError> {
        match self.known {
            Some(known) if model.gravity_m_s2 == right.gravity_m_s2 => Ok(known.between(model, right)),
            _ => {
                let torques = torques(right, states)?;
                self.torque_difference(model, ReferenceTorques { states, torques: &torques })
            }
        }
    }
}

/// The result of a diagnosis: explanations, the best first.
#[derive(Debug, Clone)]
pub(crate) struct Diagnosed {
    /// Whether the torques agree, so that there is nothing to explain.
    pub(crate) same: bool,
    /// Links of bodies that can account for the whole difference by their inertial parameters alone.
    pub(crate) links: Vec<usize>,
    /// Explanations with different corrected parameters, the best first.
    pub(crate) explanations: Vec<ExplanationGroup>,
}

/// An explanation with all causes that lead to the same corrected parameters.
#[derive(Debug, Clone)]
pub(crate) struct ExplanationGroup {
    pub(crate) named: ExactExplanation,
    /// Other causes with the same corrected parameters.
    pub(crate) also: Vec<ExactExplanation>,
    /// Why joint torques cannot distinguish it from the first explanation; `None` for the first.
    pub(crate) reason: Option<EquivalenceReason>,
}

impl ExactExplanation {
    /// As an explanation with this cause only.
    pub(crate) fn alone(self) -> ExplanationGroup {
        ExplanationGroup { named: self, also: Vec::new(), reason: None }
    }
}

/// Most explanations that are kept. Kind: choice.
const MOST_EXPLANATIONS: usize = 40;

/// Torques of a reference at some states.
#[derive(Clone, Copy)]
pub(crate) struct ReferenceTorques<'a> {
    pub(crate) states: &'a [SampledState],
    pub(crate) torques: &'a [Vec<f64>],
}

/// Explains a torque difference in two stages: beside a parameter that is 1e9 times too large any other fault is below rounding,
/// so the residual after the first correction is diagnosed again.
pub(crate) fn diagnose_in_stages(
    setting: &DiagnosisInput<'_>,
    torque: &ReducedTorqueDifference,
    expected: ReferenceTorques<'_>,
) -> Result<Diagnosed, DynamicsError> {
    let mut first = diagnose(setting, torque);
    let Some(named) = first.explanations.first().map(|grouped| grouped.named.clone()) else {
        return Ok(first);
    };
    // Second stage: with the first correction applied, precision is relative to the remaining difference.
    let corrected = named.corrected.model(setting.candidate);
    let rest = setting.torque_difference(&corrected, expected)?;
    let second = diagnose(&DiagnosisInput { candidate: &corrected, ..*setting }, &rest);
    // Nothing remains, or nothing that a cause explains: the explanation of the first stage is kept.
    if second.same || second.explanations.is_empty() {
        return Ok(first);
    }
    let both = second.explanations.into_iter().flat_map(|grouped| {
        std::iter::once(grouped.named).chain(grouped.also).map(|other| {
            let mut parts = named.parts.clone();
            for later in other.parts {
                let place = &later.hypothesis.place;
                match parts.iter_mut().find(|part| part.hypothesis.place == *place) {
                    Some(part) => part.refined_by(later, setting.candidate),
                    // What a second stage finds below the digits of the file is rounding of the first correction,
                    // no second fault.
                    None if later.is_more_than_rounding(setting.candidate) => parts.push(later),
                    None => {}
                }
            }
            ExactExplanation::new(parts, setting.candidate, setting.reference)
        })
    });
    let mut both: Vec<ExactExplanation> = both.collect();
    sort(&mut both);
    first.explanations = grouped(setting.candidate, torque, both);
    Ok(first)
}

/// One stage of the diagnosis.
fn diagnose(setting: &DiagnosisInput<'_>, torque: &ReducedTorqueDifference) -> Diagnosed {
    let size = libm::hypot(torque.difference.norm(), torque.outside);
    let exact = setting.precision.exact(size, torque.torques);
    let target = Target { model: setting.candidate, torque, exact };
    if size <= setting.precision.same * torque.torques {
        return Diagnosed { same: true, links: Vec::new(), explanations: Vec::new() };
    }
    let frames = &setting.candidate.frames;
    // A body contains the difference if it lies in the span of its ten columns, whatever their values: it says
    // where, even if no cause says why.
    let containing = (0..frames.dof()).filter(|&body| target.contains(RobotPart::Body(body)));
    let links = containing.flat_map(|body| frames.links_of(body)).collect();
    let catalogue = Catalogue::new(setting.candidate, setting.reference, setting.faulty);
    let exactly = |parts| ExactExplanation::new(parts, setting.candidate, setting.reference);
    let is_possible = |exact: &ExactExplanation| !exact.is_impossible(setting.candidate, setting.reference);
    let singles = catalogue.singles(&target).into_iter().map(|fit| exactly(vec![fit]));
    // An impossible explanation (negative armature, another gravity in a URDF) must not keep pairs from being tried.
    let mut found: Vec<ExactExplanation> = singles.filter(is_possible).collect();
    // Pairs grow with the square of the parts; they are tried only if no single cause is convincing.
    if setting.pairs && found.iter().all(|exact| exact.free_numbers() > PAIRS_ABOVE) {
        let pairs = catalogue.pairs(&target).into_iter().map(|pair| exactly(pair.into()));
        found.extend(pairs.filter(is_possible));
    }
    sort(&mut found);
    Diagnosed { same: false, links, explanations: grouped(setting.candidate, torque, found) }
}

fn sort(found: &mut [ExactExplanation]) {
    found.sort_by(|a, b| a.rank().cmp(&b.rank()));
}

/// Groups explanations with the same corrected parameters; the first of each group is the simplest.
fn grouped(
    model: &DynamicsModel,
    torque: &ReducedTorqueDifference,
    found: Vec<ExactExplanation>,
) -> Vec<ExplanationGroup> {
    let mut groups: Vec<ExplanationGroup> = Vec::new();
    for exact in found {
        if let Some(group) = groups.iter_mut().find(|group| group.named.has_parameters_of(&exact, model)) {
            group.also.push(exact);
            continue;
        }
        // After the search for a group, so that further names of an explanation that is kept are not lost.
        if groups.len() == MOST_EXPLANATIONS {
            continue;
        }
        let reason =
            groups.first().map(|first| EquivalenceReason::between(model, torque, &first.named, &exact));
        groups.push(ExplanationGroup { named: exact, also: Vec::new(), reason });
    }
    groups
}
