//! Differences of two descriptions that no joint torque shows.

use nalgebra::Matrix3;

use super::figures::{FigureDifference, of_link};
use crate::{
    side::{Inertial, Side},
    thresholds::{Precision, SEEN},
    torque::compressed::Compressed,
};

/// All figures that differ, and those of them whose difference alone changes no torque; all of them if none does.
pub(crate) fn differences(
    candidate: &Side,
    reference: &Side,
    torque: &Compressed,
    same_torques: bool,
) -> [Vec<FigureDifference>; 2] {
    let [mut all, mut hidden] = [Vec::new(), Vec::new()];
    for (link, place) in candidate.frames.links.iter().enumerate() {
        let Some(other) = reference.frames.find_link(&place.name) else { continue };
        let sides = [candidate.inertials[link], reference.inertials[other]];
        let [found, expected] = &sides;
        for difference in of_link(&place.name, found.as_ref(), expected.as_ref()) {
            if same_torques || !is_seen(torque, link, sides, &difference.figure) {
                hidden.push(difference.clone());
            }
            all.push(difference);
        }
    }
    [all, hidden]
}

/// Whether the difference of one figure, alone, changes a torque.
fn is_seen(torque: &Compressed, link: usize, sides: [Option<Inertial>; 2], figure: &str) -> bool {
    let (Some(block), [Some(found), Some(expected)]) = (torque.link(link), sides) else {
        return torque.link(link).is_some();
    };
    let mut changed = found;
    let (tensor, other) = (found.tensor_in_link(), expected.tensor_in_link());
    match figure {
        "mass" => changed.mass_kg = expected.mass_kg,
        "com_x" => changed.com_m.x = expected.com_m.x,
        "com_y" => changed.com_m.y = expected.com_m.y,
        "com_z" => changed.com_m.z = expected.com_m.z,
        "ixx" => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (0, 0))),
        "ixy" => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (0, 1))),
        "ixz" => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (0, 2))),
        "iyy" => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (1, 1))),
        "iyz" => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (1, 2))),
        _ => changed = changed.with_tensor_in_link(&with_entry(tensor, &other, (2, 2))),
    }
    let change = changed.ten_numbers() - found.ten_numbers();
    let effect = (block * change).norm();
    effect > (Precision::EXACT.of_torque * torque.torques).max(SEEN * torque.scale * change.norm())
}

fn with_entry(mut tensor: Matrix3<f64>, other: &Matrix3<f64>, (row, column): (usize, usize)) -> Matrix3<f64> {
    tensor[(row, column)] = other[(row, column)];
    tensor[(column, row)] = other[(column, row)];
    tensor
}
