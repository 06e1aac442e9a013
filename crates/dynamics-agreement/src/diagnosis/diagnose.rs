//! The explanations of a difference, in order.

use congruent_description::Elementary as _;
use congruent_dynamics::DynamicsError;

use super::{
    fit::Target,
    hypothesis::FaultySide,
    rank::Exact,
    reason::EquivalenceReason,
    search::{Catalogue, Part},
};
use crate::{
    side::Side,
    thresholds::{PAIRS_ABOVE, Precision},
    torque::{compressed::Compressed, states::State},
};

/// Whose parameters are taken to be wrong, and what is known.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    pub(crate) candidate: &'a Side,
    /// The other description, if there is one: explanations that change what is equal in both come last.
    pub(crate) reference: Option<&'a Side>,
    pub(crate) faulty: FaultySide,
    pub(crate) precision: Precision,
    /// Whether faults at two places at once are looked for.
    pub(crate) pairs: bool,
}

/// What explains a difference.
#[derive(Debug, Clone)]
pub(crate) struct Diagnosed {
    /// Whether there is no difference to explain.
    pub(crate) same: bool,
    /// Links whose numbers alone can contain the difference.
    pub(crate) links: Vec<usize>,
    /// Explanations with different parameters, the first one named.
    pub(crate) explanations: Vec<Grouped>,
}

/// An explanation with all its names.
#[derive(Debug, Clone)]
pub(crate) struct Grouped {
    pub(crate) named: Exact,
    /// Others that end at the same parameters.
    pub(crate) also: Vec<Exact>,
    /// Why it cannot be told from the first.
    pub(crate) reason: Option<EquivalenceReason>,
}

impl Exact {
    /// As an explanation without others.
    pub(crate) fn alone(self) -> Grouped {
        Grouped { named: self, also: Vec::new(), reason: None }
    }
}

/// Most explanations that are kept. Kind: choice; more of them say no more.
const MOST_EXPLANATIONS: usize = 40;

/// Torques of a reference at some states.
#[derive(Clone, Copy)]
pub(crate) struct Expected<'a> {
    pub(crate) states: &'a [State],
    pub(crate) torques: &'a [Vec<f64>],
}

/// Finds what explains a difference of torque. Beside a parameter that is a thousand million times too large any other
/// fault is rounding: what is left after the correction of the first is looked at again.
pub(crate) fn diagnose_in_stages(
    setting: &Setting<'_>,
    torque: &Compressed,
    expected: Expected<'_>,
) -> Result<Diagnosed, DynamicsError> {
    let mut first = diagnose(setting, torque);
    let Some(named) = first.explanations.first().map(|grouped| grouped.named.clone()) else {
        return Ok(first);
    };
    let corrected = named.corrected.side(setting.candidate);
    let rest = Compressed::new(&corrected, expected.states, expected.torques)?;
    let second = diagnose(&Setting { candidate: &corrected, ..*setting }, &rest);
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
                    None if later.is_more_than_rounding(setting.candidate) => parts.push(later),
                    None => {}
                }
            }
            Exact::new(parts, setting.candidate, setting.reference)
        })
    });
    let mut both: Vec<Exact> = both.collect();
    sort(&mut both);
    first.explanations = grouped(setting.candidate, torque, both);
    Ok(first)
}

/// The same in one stage.
fn diagnose(setting: &Setting<'_>, torque: &Compressed) -> Diagnosed {
    let size = torque.difference.norm().hypotenuse_with(torque.outside);
    let exact = setting.precision.exact(size, torque.torques);
    let target = Target { side: setting.candidate, torque, exact };
    if size <= setting.precision.same * torque.torques {
        return Diagnosed { same: true, links: Vec::new(), explanations: Vec::new() };
    }
    let frames = &setting.candidate.frames;
    let containing = (0..frames.dof()).filter(|&body| target.contains(Part::Body(body)));
    let links = containing.flat_map(|body| frames.links_of(body)).collect();
    let catalogue = Catalogue::new(setting.candidate, setting.reference, setting.faulty);
    let exactly = |parts| Exact::new(parts, setting.candidate, setting.reference);
    let is_possible = |exact: &Exact| !exact.is_impossible(setting.candidate, setting.reference);
    let singles = catalogue.singles(&target).into_iter().map(|fit| exactly(vec![fit]));
    let mut found: Vec<Exact> = singles.filter(is_possible).collect();
    if setting.pairs && found.iter().all(|exact| exact.free_numbers() > PAIRS_ABOVE) {
        let pairs = catalogue.pairs(&target).into_iter().map(|pair| exactly(pair.into()));
        found.extend(pairs.filter(is_possible));
    }
    sort(&mut found);
    Diagnosed { same: false, links, explanations: grouped(setting.candidate, torque, found) }
}

fn sort(found: &mut [Exact]) {
    found.sort_by(|a, b| a.rank().cmp(&b.rank()));
}

/// Puts explanations with the same parameters together.
fn grouped(side: &Side, torque: &Compressed, found: Vec<Exact>) -> Vec<Grouped> {
    let mut groups: Vec<Grouped> = Vec::new();
    for exact in found {
        if let Some(group) = groups.iter_mut().find(|group| group.named.has_parameters_of(&exact, side)) {
            group.also.push(exact);
            continue;
        }
        if groups.len() == MOST_EXPLANATIONS {
            continue;
        }
        let reason =
            groups.first().map(|first| EquivalenceReason::between(side, torque, &first.named, &exact));
        groups.push(Grouped { named: exact, also: Vec::new(), reason });
    }
    groups
}
