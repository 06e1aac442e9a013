//! Mistakes with a centre of mass: signs, order of coordinates, mirrored parts.

use nalgebra::{Matrix3, Vector3};

use super::common_mistake::CommonMistake;
use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    model::Inertial,
};

const AXES: [&str; 3] = ["x", "y", "z"];

/// For each of the three coordinates, the index of the right coordinate that was written there.
const ORDERS: [(&str, [usize; 3]); 5] = [
    ("xy", [1, 0, 2]),
    ("xz", [2, 1, 0]),
    ("yz", [0, 2, 1]),
    ("cycle", [2, 0, 1]),
    ("cycle_back", [1, 2, 0]),
];

pub(super) fn mistakes<'a>(faulty: FaultySide) -> Vec<CommonMistake<'a>> {
    let mut mistakes = Vec::new();
    let com = |parameters: &Inertial, com_m: Vector3<f64>| Inertial { com_m, ..*parameters };
    for (axis, name) in AXES.into_iter().enumerate() {
        mistakes.push(CommonMistake::new(DynamicsCause::ComSign, name, move |parameters| {
            com(parameters, mirror(axis) * parameters.com_m)
        }));
    }
    mistakes.push(CommonMistake::new(DynamicsCause::ComSign, "all", move |parameters| {
        com(parameters, -parameters.com_m)
    }));
    for (name, order) in ORDERS {
        mistakes.push(CommonMistake::new(DynamicsCause::ComAxesSwapped, name, move |parameters| {
            com(parameters, reordered(faulty, order, &parameters.com_m))
        }));
    }
    // A mirrored part has both its centre of mass and its products of inertia mirrored (M I M); a sign of the
    // centre of mass alone is the cause before.
    for (axis, name) in AXES.into_iter().enumerate() {
        let mirror = mirror(axis);
        mistakes.push(CommonMistake::new(DynamicsCause::Mirrored, name, move |parameters| {
            com(parameters, mirror * parameters.com_m)
                .with_tensor_in_link(&(mirror * parameters.tensor_in_link() * mirror))
        }));
    }
    mistakes
}

fn mirror(axis: usize) -> Matrix3<f64> {
    let mut mirror = Matrix3::identity();
    mirror[(axis, axis)] = -1.0;
    mirror
}

/// Coordinates in the order of the mistake, or back in the right one.
fn reordered(faulty: FaultySide, order: [usize; 3], numbers: &Vector3<f64>) -> Vector3<f64> {
    let mut result = Vector3::zeros();
    for (place, taken) in order.into_iter().enumerate() {
        match faulty {
            // Undoing: what is at `place` belongs at `taken`. Doing it to right values is the inverse
            // permutation, which for a cycle is another one.
            FaultySide::Candidate => result[taken] = numbers[place],
            FaultySide::Reference => result[place] = numbers[taken],
        }
    }
    result
}
