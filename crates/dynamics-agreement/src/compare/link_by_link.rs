//! If both models are descriptions, the difference of each link is diagnosed by itself, whatever else differs.

use congruent_dynamics::DynamicsError;

use super::unmatched::Unmatched;
use crate::{
    diagnosis::{
        DiagnosisInput, ExactExplanation, ExplanationGroup, ReferenceTorques, diagnose_in_stages,
        is_same_body, part_by_part, term_by_term,
    },
    model::{DynamicsModel, Inertial},
    report::{content::DynamicsExplanation, explained::ExplanationContext, places::ModelFiles},
    thresholds::COMPLEXITY_PER_PART,
    torque::{
        reduced_difference::{ReducedTorqueDifference, torques, weights},
        states::SampledState,
    },
};

/// What is wrong with one link, with the joint terms or with gravity.
struct CauseOfLink {
    /// How much its correction alone changes all torques.
    effect: f64,
    explanation: DynamicsExplanation,
    /// `None` of a link that only one of the two has.
    named: Option<ExactExplanation>,
}

/// How much a correction changes all torques, as a share of what the joints can exert; those of a joint without a limit of effort count
/// by its torque in the reference.
struct TorqueEffect {
    weights: Vec<f64>,
    found: Vec<Vec<f64>>,
}

impl TorqueEffect {
    fn new([model, reference]: [&DynamicsModel; 2], states: &[SampledState]) -> Result<Self, DynamicsError> {
        // A finger that hardly needs a torque would outweigh the arm if its own torque was the measure.
        let of_torque = weights(&torques(reference, states)?, model.frames.dof());
        let effort = |joint: usize| {
            let stated = [model, reference].map(|of| of.limits.get(joint).copied().flatten()?.effort);
            stated.into_iter().flatten().filter(|effort| *effort > 0.0).reduce(f64::min)
        };
        let weight = |(joint, weight)| effort(joint).map_or(weight, f64::recip);
        let weights = of_torque.into_iter().enumerate().map(weight).collect();
        Ok(Self { weights, found: torques(model, states)? })
    }

    fn of(&self, corrected: &[Vec<f64>]) -> f64 {
        let of_state = |(found, corrected): (&Vec<f64>, &Vec<f64>)| -> f64 {
            let joints = self.weights.iter().zip(found.iter().zip(corrected));
            joints.map(|(weight, (found, corrected))| (weight * (corrected - found)).powi(2)).sum()
        };
        self.found.iter().zip(corrected).map(of_state).sum::<f64>().sqrt()
    }
}

/// The best explanation of each link, of the joint terms and of gravity, each by itself, in the order of their effect; two of them are merged
/// into one.
/// Empty if links with the same name do not account for the whole difference.
pub(super) fn link_by_link(
    setting: &DiagnosisInput<'_>,
    files: ModelFiles<'_>,
    reference_in_candidate: &DynamicsModel,
    whole_torque: &ReducedTorqueDifference,
    states: &[SampledState],
) -> Result<Vec<DynamicsExplanation>, DynamicsError> {
    let model = setting.candidate;
    let Some(reference) = setting.reference else { return Ok(Vec::new()) };
    let unmatched = Unmatched::new(model, reference);
    let (mut whole, corrected) = one_by_one(model, reference, reference_in_candidate);
    unmatched.correct(&mut whole);
    // If all named links together do not give the reference, something without a common name differs (a frame,
    // the tree), and causes link by link would be wrong.
    if !is_same(&whole, reference_in_candidate, setting, states)? {
        return Ok(Vec::new());
    }
    let corrected = with_exchanges(model, corrected);
    let effects = TorqueEffect::new([model, reference_in_candidate], states)?;
    let mut by_effect: Vec<CauseOfLink> = Vec::new();
    for (one, explanation) in unmatched.corrected_one_by_one().zip(unmatched.explanations(files)) {
        let effect = effects.of(&torques(&one, states)?);
        by_effect.push(CauseOfLink { effect, explanation, named: None });
    }
    for (one, link) in &corrected {
        let expected = torques(one, states)?;
        // The corrected copy is the reference of this link: every cause that changes anything else is
        // contradicted.
        let setting =
            DiagnosisInput { reference: Some(one), pairs: false, known: Some(whole_torque), ..*setting };
        let torque = setting.torque_between([model, one], states)?;
        match alone(&setting, one, *link, &torque, states)? {
            Alone::Same => {}
            // One link without a cause makes the list incomplete; the explanation by torques of the whole is then
            // preferred.
            Alone::Unexplained => return Ok(Vec::new()),
            Alone::Explained(cause) => {
                let explanation = ExplanationContext::new(&setting, files, &torque).explanation(&cause);
                let effect = effects.of(&expected);
                by_effect.push(CauseOfLink { effect, explanation, named: Some(cause.named) });
            }
        }
    }
    // What changes torques most is read first.
    by_effect.sort_by(|a, b| b.effect.total_cmp(&a.effect));
    // Two faults read better as one explanation with two parts, and have one list of edits.
    if let [CauseOfLink { named: Some(first), .. }, CauseOfLink { named: Some(second), .. }] = &by_effect[..]
    {
        let parts = first.parts.iter().chain(&second.parts).cloned().collect();
        let both = ExactExplanation::new(parts, model, setting.reference);
        return Ok(vec![ExplanationContext::new(setting, files, whole_torque).explanation(&both.alone())]);
    }
    Ok(by_effect.into_iter().map(|of| of.explanation).collect())
}

/// The explanation of the joint terms alone, if `right` is the candidate with the right ones; `None` if they differ without an
/// effect.
pub(super) fn joint_terms_alone(
    setting: &DiagnosisInput<'_>,
    files: ModelFiles<'_>,
    right: &DynamicsModel,
    states: &[SampledState],
) -> Result<Option<DynamicsExplanation>, DynamicsError> {
    let torque = setting.torque_between([setting.candidate, right], states)?;
    let setting = DiagnosisInput { reference: Some(right), pairs: false, ..*setting };
    Ok(match alone(&setting, right, None, &torque, states)? {
        Alone::Explained(cause) => {
            Some(ExplanationContext::new(&setting, files, &torque).explanation(&cause))
        }
        Alone::Same | Alone::Unexplained => None,
    })
}

/// The candidate with all parameters of the reference whose link or joint exists in both; and the candidate with one of
/// them each: gravity, the joint terms, and every link with its index.
fn one_by_one(
    model: &DynamicsModel,
    reference: &DynamicsModel,
    reference_in_candidate: &DynamicsModel,
) -> (DynamicsModel, Vec<(DynamicsModel, Option<usize>)>) {
    let mut whole = DynamicsModel { gravity_m_s2: reference_in_candidate.gravity_m_s2, ..model.clone() };
    whole.resistances.clone_from(&reference_in_candidate.resistances);
    let mut corrected = vec![
        (DynamicsModel { gravity_m_s2: whole.gravity_m_s2, ..model.clone() }, None),
        (DynamicsModel { resistances: whole.resistances.clone(), ..model.clone() }, None),
    ];
    for (link, place) in model.frames.links.iter().enumerate() {
        let Some(other) = reference.frames.find_link(&place.name) else { continue };
        // Exact comparison: rounding is sorted out by the torques of each link below. A mass that the reference does not give
        // is one of the unmatched.
        if reference.inertials[other].is_some() && reference.inertials[other] != model.inertials[link] {
            whole.inertials[link] = reference.inertials[other];
            let mut one = model.clone();
            one.inertials[link] = reference.inertials[other];
            corrected.push((one, Some(link)));
        }
    }
    (whole, corrected)
}

/// The same with two links as one if each has the right parameters, or the right mass, of the other: one by one, both would be
/// wrong by themselves, and what they are by mistake would be lost.
fn with_exchanges(
    model: &DynamicsModel,
    corrected: Vec<(DynamicsModel, Option<usize>)>,
) -> Vec<(DynamicsModel, Option<usize>)> {
    let mut merged: Vec<(DynamicsModel, Option<usize>)> = Vec::new();
    for (one, link) in corrected {
        let right = |of: &DynamicsModel, link: usize| of.inertials[link];
        let is_exchanged = |link: usize, (other, at): &(DynamicsModel, Option<usize>)| {
            at.is_some_and(|at| {
                let all = [right(&one, link), right(other, at), model.inertials[link], model.inertials[at]];
                let [Some(right), Some(other_right), Some(written), Some(other)] = all else { return false };
                let has_mass_of = |right: &Inertial, own: &Inertial, other: &Inertial| {
                    is_same_body(right, &Inertial { mass_kg: other.mass_kg, ..*own })
                };
                (is_same_body(&right, &other) && is_same_body(&other_right, &written))
                    || (has_mass_of(&right, &written, &other) && has_mass_of(&other_right, &other, &written))
            })
        };
        let partner = link.and_then(|link| merged.iter().position(|other| is_exchanged(link, other)));
        match partner.zip(link) {
            Some((partner, link)) => {
                merged[partner].0.inertials[link] = one.inertials[link];
                // The place of neither: the pair is diagnosed by all causes, those of two links among them.
                merged[partner].1 = None;
            }
            None => merged.push((one, link)),
        }
    }
    merged
}

/// The diagnosis of one link, of the joint terms or of gravity by itself.
enum Alone {
    Same,
    Explained(Box<ExplanationGroup>),
    Unexplained,
}

/// The simplest cause that changes no equal parameter: one for the whole link, or one each for its mass, centre of mass and
/// inertia; one for all joint terms, or one for each of them.
fn alone(
    setting: &DiagnosisInput<'_>,
    one: &DynamicsModel,
    link: Option<usize>,
    torque: &ReducedTorqueDifference,
    states: &[SampledState],
) -> Result<Alone, DynamicsError> {
    let expected = torques(one, states)?;
    let found = diagnose_in_stages(setting, torque, ReferenceTorques { states, torques: &expected })?;
    if found.same {
        return Ok(Alone::Same);
    }
    let by_parts = match link.and_then(|link| Some((link, one.inertials[link].as_ref()?))) {
        Some((link, right)) => part_by_part(setting, link, right, states)?,
        None => term_by_term(setting, &one.resistances, states)?,
    };
    let by_parts = by_parts.map(ExactExplanation::alone);
    let whole = found.explanations.into_iter().next();
    let best = whole.into_iter().chain(by_parts).min_by(|a, b| {
        let of = |ExplanationGroup { named, .. }: &ExplanationGroup| {
            let is_other = !named.gives_values_of(one, setting.candidate);
            ((named.contradicted, is_other), named.complexity)
        };
        let (a, b) = (of(a), of(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(best.map_or(Alone::Unexplained, |best| Alone::Explained(Box::new(best))))
}

/// Whether explanations part by part are simpler than others: they have a lower complexity, or the others change a parameter
/// that is equal in both files.
pub(super) fn is_simpler(by_part: &[DynamicsExplanation], others: &[DynamicsExplanation]) -> bool {
    let Some(first) = others.first() else { return true };
    !by_part.is_empty() && (first.contradicted || complexity(by_part) < complexity(others))
}

/// The complexity of explanations that hold together.
pub(super) fn complexity(explanations: &[DynamicsExplanation]) -> f64 {
    let parts = f64::from(u32::try_from(explanations.len().saturating_sub(1)).unwrap_or(u32::MAX));
    explanations.iter().map(|explanation| explanation.numbers).sum::<f64>() + parts * COMPLEXITY_PER_PART
}

/// Whether two models have the same torques at these states.
fn is_same(
    a: &DynamicsModel,
    b: &DynamicsModel,
    setting: &DiagnosisInput<'_>,
    states: &[SampledState],
) -> Result<bool, DynamicsError> {
    let torque = setting.torque_between([a, b], states)?;
    let size = libm::hypot(torque.difference.norm(), torque.outside);
    Ok(size <= setting.precision.same * torque.torques)
}
