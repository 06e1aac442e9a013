//! Several faults of one link at once, if the other description has the right parameters: mass, centre of mass and inertia are
//! diagnosed one after another, each with a cause of its own.

use congruent_dynamics::DynamicsError;

use super::{
    cause,
    cause_names::DynamicsCause,
    diagnose::DiagnosisInput,
    fit::{Corrected, FittedHypothesis, Target},
    free::FreeParameters,
    hypothesis::{Change, DynamicsHypothesis, DynamicsPlace},
    rank::ExactExplanation,
};
use crate::{
    model::{DynamicsModel, Inertial},
    thresholds::COMPUTED_OTHERWISE,
    torque::{reduced_difference::ReducedTorqueDifference, states::SampledState},
};

/// The cause of each part if no specific cause has a residual within tolerance.
const FREE: [(DynamicsCause, FreeParameters); 3] = [
    (DynamicsCause::Mass, FreeParameters::Mass),
    (DynamicsCause::Com, FreeParameters::Com),
    (DynamicsCause::Inertia, FreeParameters::Inertia),
];

/// Causes of the parameters of a link that differ from the other description: first of the mass, then of the centre of mass
/// with the right mass, then of the inertia with both. `None` if none of them has an effect on torques.
pub(crate) fn part_by_part(
    setting: &DiagnosisInput<'_>,
    link: usize,
    right: &Inertial,
    states: &[SampledState],
) -> Result<Option<ExactExplanation>, DynamicsError> {
    let Some(written) = setting.candidate.inertials[link] else { return Ok(None) };
    // Beside another mass, a tensor that is computed otherwise in its last digits is no fault of its own.
    let [tensor, other] = [written, *right].map(|of| of.tensor_in_link());
    let right = if (tensor - other).amax() <= COMPUTED_OTHERWISE * other.amax() {
        Inertial { mass_kg: right.mass_kg, com_m: right.com_m, ..written }
    } else {
        *right
    };
    let mistakes = cause::mistakes(&setting.candidate.frames, setting.faulty);
    let mut before = setting.candidate.clone();
    let mut parts = Vec::new();
    // Mass first: centre of mass and tensor about the origin depend on it, so each later part is judged with the
    // earlier ones right.
    let with_mass = Inertial { mass_kg: right.mass_kg, ..written };
    let with_com = Inertial { com_m: right.com_m, ..with_mass };
    for (next, (cause, free)) in [with_mass, with_com, right].into_iter().zip(FREE) {
        let mut after = before.clone();
        after.inertials[link] = Some(next);
        let torque = setting.torque_between([&before, &after], states)?;
        let hypotheses = cause::link_hypotheses(&before, Some(&after), setting.faulty, &mistakes, link);
        let place = DynamicsPlace::Links(vec![link]);
        let off = FittedHypothesis {
            hypothesis: DynamicsHypothesis::new(cause, "", place, Change::FreeLink { link, free }),
            corrected: Corrected { links: vec![(link, next)], ..Corrected::default() },
            residual_norm: 0.0,
            rank: free.count(),
        };
        parts.extend(best_cause(setting, [&before, &after], &torque, &hypotheses, off));
        // Each part is compared with the one before it, so that its torque difference is that of this part alone.
        before = after;
    }
    Ok((!parts.is_empty()).then(|| ExactExplanation::new(parts, setting.candidate, setting.reference)))
}

/// The best of some causes of one part, else `off`, with the values of `off`; `None` if the part has no effect on torques.
pub(super) fn best_cause(
    setting: &DiagnosisInput<'_>,
    [before, after]: [&DynamicsModel; 2],
    torque: &ReducedTorqueDifference,
    hypotheses: &[DynamicsHypothesis],
    off: FittedHypothesis,
) -> Option<FittedHypothesis> {
    let size = libm::hypot(torque.difference.norm(), torque.outside);
    if size <= setting.precision.same * torque.torques {
        return None;
    }
    let exact = setting.precision.exact(size, torque.torques);
    let target = Target { model: before, torque, exact };
    let fits = hypotheses.iter().filter_map(|hypothesis| target.fit(hypothesis));
    let mut found: Vec<ExactExplanation> = fits
        .map(|fit| ExactExplanation::new(vec![fit], before, Some(after)))
        // The other description says what is right here: a cause that changes an equal value is refuted.
        .filter(|exact| !exact.contradicted)
        .collect();
    found.sort_by(|a, b| a.rank().cmp(&b.rank()));
    let best = found.into_iter().next().and_then(|mut exact| exact.parts.pop());
    // Not every free parameter is identifiable, so the values come from the other description, not from the fit.
    let corrected = off.corrected.clone();
    Some(FittedHypothesis { corrected, ..best.unwrap_or(off) })
}
