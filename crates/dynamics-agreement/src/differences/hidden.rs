//! Parameters that differ between two descriptions without an effect on any joint torque.

use super::parameters::{ParameterDifference, link_differences};
use crate::{
    model::{DynamicsModel, Inertial},
    thresholds::{IDENTIFIABLE, Precision},
    torque::reduced_difference::ReducedTorqueDifference,
};

/// All parameters of links that differ, with or without an effect on torques.
pub(crate) fn differences(candidate: &DynamicsModel, reference: &DynamicsModel) -> Vec<ParameterDifference> {
    differing(candidate, reference).into_iter().map(|(_, difference)| difference).collect()
}

/// The parameters whose difference alone changes no torque, and those that change at most the share `most` of all torques,
/// with their share: it is below the resolution, or the other differences cancel it.
pub(crate) fn without_effect(
    candidate: &DynamicsModel,
    reference: &DynamicsModel,
    torque: &ReducedTorqueDifference,
    most: f64,
) -> Vec<ParameterDifference> {
    let hidden = differing(candidate, reference).into_iter().filter_map(|(pair, difference)| {
        match torque_share(torque, &pair, &difference.parameter) {
            None => Some(difference),
            Some(share) if share > most => None,
            Some(share) if share > Precision::EXACT.same => {
                Some(ParameterDifference { cancelled: Some(share), ..difference })
            }
            Some(share) => Some(ParameterDifference { below_resolution: Some(share), ..difference }),
        }
    });
    hidden.collect()
}

/// The inertials of one link in both descriptions.
struct LinkPair {
    link: usize,
    found: Option<Inertial>,
    expected: Option<Inertial>,
}

fn differing(candidate: &DynamicsModel, reference: &DynamicsModel) -> Vec<(LinkPair, ParameterDifference)> {
    let mut all = Vec::new();
    for (link, place) in candidate.frames.links.iter().enumerate() {
        let Some(other) = reference.frames.find_link(&place.name) else { continue };
        let (found, expected) = (candidate.inertials[link], reference.inertials[other]);
        let differences = link_differences(&place.name, found.as_ref(), expected.as_ref()).into_iter();
        all.extend(differences.map(|difference| (LinkPair { link, found, expected }, difference)));
    }
    all
}

/// The share of all torques by which the difference of one parameter alone changes them; `None` if it is not identifiable.
fn torque_share(torque: &ReducedTorqueDifference, pair: &LinkPair, parameter: &str) -> Option<f64> {
    let block = torque.link(pair.link)?;
    let [found, expected] = [pair.found, pair.expected].map(|of| of.unwrap_or_else(Inertial::nothing));
    let mut changed = found;
    let with_entry = |row: usize, column: usize| {
        let (mut tensor, other) = (found.tensor_in_link(), expected.tensor_in_link());
        tensor[(row, column)] = other[(row, column)];
        tensor[(column, row)] = other[(column, row)];
        found.with_tensor_in_link(&tensor)
    };
    match parameter {
        "mass" => changed.mass_kg = expected.mass_kg,
        "com_x" => changed.com_m.x = expected.com_m.x,
        "com_y" => changed.com_m.y = expected.com_m.y,
        "com_z" => changed.com_m.z = expected.com_m.z,
        "ixx" => changed = with_entry(0, 0),
        "ixy" => changed = with_entry(0, 1),
        "ixz" => changed = with_entry(0, 2),
        "iyy" => changed = with_entry(1, 1),
        "iyz" => changed = with_entry(1, 2),
        _ => changed = with_entry(2, 2),
    }
    let change = changed.ten_numbers() - found.ten_numbers();
    let effect = (block * change).norm();
    let is_identifiable = effect > IDENTIFIABLE * torque.scale * change.norm();
    is_identifiable.then(|| effect / torque.torques)
}
