//! Several faults of one link at once, if the other description has the right parameters: mass, centre of mass and inertia are
//! diagnosed one after another, each with a cause of its own.

use congruent_dynamics::DynamicsError;

use super::{
    cause::{self, common_mistake::CommonMistake},
    cause_names::DynamicsCause,
    diagnose::DiagnosisInput,
    fit::{Corrected, FittedHypothesis, Target},
    free::FreeParameters,
    hypothesis::{Change, DynamicsHypothesis, DynamicsPlace},
    rank::ExactExplanation,
};
use crate::{
    model::{DynamicsModel, Inertial},
    torque::{
        reduced_difference::{ReducedTorqueDifference, torques},
        states::SampledState,
    },
};

/// The cause of each part if no specific cause has a residual within tolerance.
const FREE: [(DynamicsCause, FreeParameters); 3] = [
    (DynamicsCause::Mass, FreeParameters::Mass),
    (DynamicsCause::Com, FreeParameters::Com),
    (DynamicsCause::Inertia, FreeParameters::Inertia),
];

/// One part of a link's parameters: its mass, its centre of mass or its inertia.
struct LinkPart<'a> {
    link: usize,
    /// The common mistakes that may explain it.
    mistakes: &'a [CommonMistake<'a>],
    /// The cause if none of the specific ones has a residual within tolerance, and its parameters.
    cause: DynamicsCause,
    free: FreeParameters,
}

/// Causes of the parameters of a link that differ from the other description: first of the mass, then of the centre of mass
/// with the right mass, then of the inertia with both. `None` if none of them has an effect on torques.
pub(crate) fn part_by_part(
    setting: &DiagnosisInput<'_>,
    link: usize,
    right: &Inertial,
    states: &[SampledState],
) -> Result<Option<ExactExplanation>, DynamicsError> {
    let Some(written) = setting.candidate.inertials[link] else { return Ok(None) };
    let mistakes = cause::mistakes(&setting.candidate.frames, setting.faulty);
    let mut before = setting.candidate.clone();
    let mut parts = Vec::new();
    // Mass first: centre of mass and tensor about the origin depend on it, so each later part is judged with the
    // earlier ones right.
    let with_mass = Inertial { mass_kg: right.mass_kg, ..written };
    let with_com = Inertial { com_m: right.com_m, ..with_mass };
    for (next, (cause, free)) in [with_mass, with_com, *right].into_iter().zip(FREE) {
        let mut after = before.clone();
        after.inertials[link] = Some(next);
        let torque = ReducedTorqueDifference::new(&before, states, &torques(&after, states)?)?;
        let part = LinkPart { link, mistakes: &mistakes, cause, free };
        parts.extend(one_part(setting, [&before, &after], &torque, &part));
        // Each part is compared with the one before it, so that its torque difference is that of this part alone.
        before = after;
    }
    Ok((!parts.is_empty()).then(|| ExactExplanation::new(parts, setting.candidate, setting.reference)))
}

/// The best cause of one part; `None` if it has no effect on torques.
fn one_part(
    setting: &DiagnosisInput<'_>,
    [before, after]: [&DynamicsModel; 2],
    torque: &ReducedTorqueDifference,
    part: &LinkPart<'_>,
) -> Option<FittedHypothesis> {
    let &LinkPart { link, mistakes, cause, free } = part;
    let size = libm::hypot(torque.difference.norm(), torque.outside);
    if size <= setting.precision.same * torque.torques {
        return None;
    }
    let exact = setting.precision.exact(size, torque.torques);
    let target = Target { model: before, torque, exact };
    let hypotheses = cause::link_hypotheses(before, Some(after), setting.faulty, mistakes, link);
    let fits = hypotheses.iter().filter_map(|hypothesis| target.fit(hypothesis));
    let mut found: Vec<ExactExplanation> = fits
        .map(|fit| ExactExplanation::new(vec![fit], before, Some(after)))
        // The other description says what is right here: a cause that changes an equal value is refuted.
        .filter(|exact| !exact.contradicted)
        .collect();
    found.sort_by(|a, b| a.rank().cmp(&b.rank()));
    let best = found.into_iter().next().and_then(|mut exact| exact.parts.pop());
    let off = || {
        let hypothesis = DynamicsHypothesis::new(
            cause,
            "",
            DynamicsPlace::Links(vec![link]),
            Change::FreeLink { link, free },
        );
        FittedHypothesis {
            hypothesis,
            corrected: Corrected::default(),
            residual_norm: 0.0,
            rank: free.count(),
        }
    };
    // Not every free parameter is identifiable, so the values come from the other description, not from the fit.
    let corrected = Corrected { links: vec![(link, after.inertials[link]?)], ..Corrected::default() };
    Some(FittedHypothesis { corrected, ..best.unwrap_or_else(off) })
}
