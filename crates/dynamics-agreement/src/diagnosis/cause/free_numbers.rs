//! Parameters that are simply off: numbers to fit.

use nalgebra::Matrix3;

use super::tensor::{could_be_by_rows, put_back_from_rows};
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        free::{ENTRIES, Free},
        hypothesis::{Change, FaultySide, Hypothesis, Place},
    },
    side::{Inertial, Side},
    thresholds::ZERO_VALUE,
};

const AXES: [&str; 3] = ["x", "y", "z"];
const ENTRY_NAMES: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

pub(super) fn of_link(side: &Side, faulty: FaultySide, link: usize) -> Vec<Hypothesis> {
    let Some(parameters) = &side.inertials[link] else { return Vec::new() };
    let free = |cause, detail: &str, free| {
        Hypothesis::new(cause, detail, Place::Links(vec![link]), Change::FreeLink { link, free })
    };
    let mut hypotheses = vec![
        free(DynamicsCause::Mass, "", Free::Mass),
        free(DynamicsCause::Density, "", Free::Density),
        free(DynamicsCause::InertiaScale, "", Free::InertiaScale),
        free(DynamicsCause::Com, "", Free::Com),
        free(DynamicsCause::Inertia, "", Free::Inertia),
        free(DynamicsCause::Inertial, "", Free::Inertial),
    ];
    for (axis, name) in AXES.into_iter().enumerate() {
        hypotheses.push(free(DynamicsCause::ComEntry, name, Free::ComEntry(axis)));
    }
    for ((row, column), name) in ENTRIES.into_iter().zip(ENTRY_NAMES) {
        hypotheses.push(free(DynamicsCause::InertiaEntry, name, Free::InertiaEntry(row, column)));
    }
    let body = side.frames.links[link].body;
    let is_tip = body.is_some_and(|body| side.frames.joints.iter().all(|joint| joint.parent != Some(body)));
    if is_tip && body.is_some_and(|body| side.frames.joints[body].link == link) {
        hypotheses.push(free(DynamicsCause::Payload, "", Free::Payload));
    }
    let rotation = Free::Rotation(Matrix3::identity());
    hypotheses.push(free(DynamicsCause::InertiaRotation, "", rotation));
    if faulty == FaultySide::Candidate && is_principal(parameters) {
        hypotheses.push(free(DynamicsCause::PrincipalAxesMissing, "", rotation));
    }
    if faulty == FaultySide::Candidate && could_be_by_rows(parameters) {
        hypotheses.push(by_rows(link, parameters));
    }
    hypotheses
}

/// Whether different moments are given in the link's own axes, without products.
fn is_principal(parameters: &Inertial) -> bool {
    let tensor = parameters.tensor_in_link();
    let off_diagonal = tensor - Matrix3::from_diagonal(&tensor.diagonal());
    off_diagonal.amax() <= ZERO_VALUE * tensor.amax()
}

/// Nine numbers by rows, cut to six: five are put back, the last moment is free.
fn by_rows(link: usize, parameters: &Inertial) -> Hypothesis {
    let change =
        Change::FreeLinkFrom { link, from: put_back_from_rows(parameters), free: Free::InertiaEntry(2, 2) };
    Hypothesis::new(DynamicsCause::InertiaOrder, "row_major_upper", Place::Links(vec![link]), change)
}
