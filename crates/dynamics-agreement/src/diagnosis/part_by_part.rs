//! Several faults of one link at once, where the other description says what its parameters should be: mass, centre of
//! mass and inertia each have a cause of their own.

use congruent_description::Elementary as _;
use congruent_dynamics::DynamicsError;

use super::{
    cause,
    cause::slip::Slip,
    cause_names::DynamicsCause,
    diagnose::Setting,
    fit::{Corrected, Fit, Target},
    free::Free,
    hypothesis::{Change, Hypothesis, Place},
    rank::Exact,
};
use crate::{
    side::{Inertial, Side},
    torque::{
        compressed::{Compressed, torques},
        states::State,
    },
};

/// What each part is if no other cause leaves nothing.
const FREE: [(DynamicsCause, Free); 3] = [
    (DynamicsCause::Mass, Free::Mass),
    (DynamicsCause::Com, Free::Com),
    (DynamicsCause::Inertia, Free::Inertia),
];

/// Causes of the parts of a link that are not as the other description has them: first of the mass, then of the centre
/// of mass with the right mass, then of the inertia with both. `None` if torque shows none of them.
pub(crate) fn part_by_part(
    setting: &Setting<'_>,
    (link, right): (usize, &Inertial),
    states: &[State],
) -> Result<Option<Exact>, DynamicsError> {
    let Some(written) = setting.candidate.inertials[link] else { return Ok(None) };
    let slips = cause::slips(&setting.candidate.frames, setting.faulty);
    let mut before = setting.candidate.clone();
    let mut parts = Vec::new();
    let with_mass = Inertial { mass_kg: right.mass_kg, ..written };
    let with_com = Inertial { com_m: right.com_m, ..with_mass };
    for (next, free) in [with_mass, with_com, *right].into_iter().zip(FREE) {
        let mut after = before.clone();
        after.inertials[link] = Some(next);
        let torque = Compressed::new(&before, states, &torques(&after, states)?)?;
        parts.extend(one_part(setting, [&before, &after], &torque, (link, &slips, free)));
        before = after;
    }
    Ok((!parts.is_empty()).then(|| Exact::new(parts, setting.candidate, setting.reference)))
}

/// The best cause of one part; `None` if torque does not show it.
fn one_part(
    setting: &Setting<'_>,
    [before, after]: [&Side; 2],
    torque: &Compressed,
    (link, slips, (cause, free)): (usize, &[Slip<'_>], (DynamicsCause, Free)),
) -> Option<Fit> {
    let size = torque.difference.norm().hypotenuse_with(torque.outside);
    if size <= setting.precision.same * torque.torques {
        return None;
    }
    let exact = setting.precision.exact(size, torque.torques);
    let target = Target { side: before, torque, exact };
    let hypotheses = cause::of_link(before, Some(after), setting.faulty, slips, link);
    let fits = hypotheses.iter().filter_map(|hypothesis| target.fit(hypothesis));
    let mut found: Vec<Exact> = fits
        .map(|fit| Exact::new(vec![fit], before, Some(after)))
        .filter(|exact| !exact.contradicted)
        .collect();
    found.sort_by(|a, b| a.rank().cmp(&b.rank()));
    let best = found.into_iter().next().and_then(|mut exact| exact.parts.pop());
    let off = || {
        let hypothesis =
            Hypothesis::new(cause, "", Place::Links(vec![link]), Change::FreeLink { link, free });
        Fit { hypothesis, corrected: Corrected::default(), left: 0.0, rank: free.count() }
    };
    // Torque does not show every number that is free: what the other description has is what is right.
    let corrected = Corrected { links: vec![(link, after.inertials[link]?)], ..Corrected::default() };
    Some(Fit { corrected, ..best.unwrap_or_else(off) })
}
