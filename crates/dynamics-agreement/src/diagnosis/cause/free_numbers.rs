//! Hypotheses with free parameters: values that are wrong for no specific reason.

use nalgebra::Matrix3;

use super::tensor::{could_be_by_rows, put_back_from_rows};
use crate::{
    diagnosis::{
        cause_names::DynamicsCause,
        free::{ENTRIES, FreeParameters},
        hypothesis::{Change, DynamicsHypothesis, DynamicsPlace, FaultySide},
    },
    model::{DynamicsModel, Inertial},
    thresholds::ZERO_VALUE,
};

const AXES: [&str; 3] = ["x", "y", "z"];
const ENTRY_NAMES: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

pub(super) fn link_hypotheses(
    model: &DynamicsModel,
    faulty: FaultySide,
    link: usize,
) -> Vec<DynamicsHypothesis> {
    let Some(parameters) = &model.inertials[link] else { return Vec::new() };
    let free = |cause, detail: &str, free| {
        DynamicsHypothesis::new(
            cause,
            detail,
            DynamicsPlace::Links(vec![link]),
            Change::FreeLink { link, free },
        )
    };
    let mut hypotheses = vec![
        free(DynamicsCause::Mass, "", FreeParameters::Mass),
        free(DynamicsCause::Density, "", FreeParameters::Density),
        free(DynamicsCause::InertiaScale, "", FreeParameters::InertiaScale),
        free(DynamicsCause::Com, "", FreeParameters::Com),
        free(DynamicsCause::Inertia, "", FreeParameters::Inertia),
        free(DynamicsCause::Inertial, "", FreeParameters::Inertial),
    ];
    for (axis, name) in AXES.into_iter().enumerate() {
        hypotheses.push(free(DynamicsCause::ComEntry, name, FreeParameters::ComEntry(axis)));
    }
    for ((row, column), name) in ENTRIES.into_iter().zip(ENTRY_NAMES) {
        hypotheses.push(free(DynamicsCause::InertiaEntry, name, FreeParameters::InertiaEntry(row, column)));
    }
    // A payload hangs on any of the links that are fixed together at the end of the chain; a point mass elsewhere is a fault
    // of that link.
    if model.frames.is_at_tip(link) {
        hypotheses.push(free(DynamicsCause::Payload, "", FreeParameters::Payload));
    }
    let rotation = FreeParameters::Rotation(Matrix3::identity());
    hypotheses.push(free(DynamicsCause::InertiaRotation, "", rotation));
    // Only a file can lack the axes: what was built from it would have to be known to be principal in other axes.
    if faulty == FaultySide::Candidate && is_principal(parameters) {
        // The same fit as the rotation above, under the name that a diagonal tensor gives evidence for.
        hypotheses.push(free(DynamicsCause::PrincipalAxesMissing, "", rotation));
    }
    if faulty == FaultySide::Candidate && could_be_by_rows(parameters) {
        hypotheses.push(by_rows(link, parameters));
    }
    hypotheses
}

/// Whether the tensor in the link's axes is diagonal: the moments may be principal ones whose axes were not written.
fn is_principal(parameters: &Inertial) -> bool {
    let tensor = parameters.tensor_in_link();
    let off_diagonal = tensor - Matrix3::from_diagonal(&tensor.diagonal());
    off_diagonal.amax() <= ZERO_VALUE * tensor.amax()
}

/// Nine entries by rows that were cut to six: five are restored, the last moment is free.
fn by_rows(link: usize, parameters: &Inertial) -> DynamicsHypothesis {
    let change = Change::FreeLinkFrom {
        link,
        from: put_back_from_rows(parameters),
        free: FreeParameters::InertiaEntry(2, 2),
    };
    DynamicsHypothesis::new(
        DynamicsCause::InertiaOrder,
        "row_major_upper",
        DynamicsPlace::Links(vec![link]),
        change,
    )
}
