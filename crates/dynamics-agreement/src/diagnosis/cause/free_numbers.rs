//! Figures that are simply off: numbers to fit.

use nalgebra::Matrix3;

use super::tensor::{could_be_by_rows, put_back_from_rows};
use crate::{
    diagnosis::{
        cause_names::Cause,
        free::{ENTRIES, Free},
        hypothesis::{Change, Hypothesis, Place, Suspect},
    },
    side::{Inertial, Side},
    thresholds::ZERO_FIGURE,
};

const AXES: [&str; 3] = ["x", "y", "z"];
const ENTRY_NAMES: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

pub(super) fn of_link(side: &Side, suspect: Suspect, link: usize) -> Vec<Hypothesis> {
    let Some(figures) = &side.inertials[link] else { return Vec::new() };
    let free = |cause, detail: &str, free| {
        Hypothesis::new(cause, detail, Place::Links(vec![link]), Change::FreeLink { link, free })
    };
    let mut hypotheses = vec![
        free(Cause::Mass, "", Free::Mass),
        free(Cause::Density, "", Free::Density),
        free(Cause::InertiaScale, "", Free::InertiaScale),
        free(Cause::Com, "", Free::Com),
        free(Cause::Inertia, "", Free::Inertia),
        free(Cause::Inertial, "", Free::Inertial),
    ];
    for (axis, name) in AXES.into_iter().enumerate() {
        hypotheses.push(free(Cause::ComEntry, name, Free::ComEntry(axis)));
    }
    for ((row, column), name) in ENTRIES.into_iter().zip(ENTRY_NAMES) {
        hypotheses.push(free(Cause::InertiaEntry, name, Free::InertiaEntry(row, column)));
    }
    let body = side.frames.links[link].body;
    let is_tip = body.is_some_and(|body| side.frames.joints.iter().all(|joint| joint.parent != Some(body)));
    if is_tip && body.is_some_and(|body| side.frames.joints[body].link == link) {
        hypotheses.push(free(Cause::Payload, "", Free::Payload));
    }
    let rotation = Free::Rotation(Matrix3::identity());
    hypotheses.push(free(Cause::InertiaRotation, "", rotation));
    if suspect == Suspect::Candidate && is_principal(figures) {
        hypotheses.push(free(Cause::PrincipalAxesMissing, "", rotation));
    }
    if suspect == Suspect::Candidate && could_be_by_rows(figures) {
        hypotheses.push(by_rows(link, figures));
    }
    hypotheses
}

/// Whether different moments are given in the link's own axes, without products.
fn is_principal(figures: &Inertial) -> bool {
    let tensor = figures.tensor_in_link();
    let off_diagonal = tensor - Matrix3::from_diagonal(&tensor.diagonal());
    off_diagonal.amax() <= ZERO_FIGURE * tensor.amax()
}

/// Nine numbers by rows, cut to six: five are put back, the last moment is free.
fn by_rows(link: usize, figures: &Inertial) -> Hypothesis {
    let change =
        Change::FreeLinkFrom { link, from: put_back_from_rows(figures), free: Free::InertiaEntry(2, 2) };
    Hypothesis::new(Cause::InertiaOrder, "row_major_upper", Place::Links(vec![link]), change)
}
