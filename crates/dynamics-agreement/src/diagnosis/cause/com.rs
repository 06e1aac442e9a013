//! Signs and order of a centre of mass, and mirrored parts.

use nalgebra::{Matrix3, Vector3};

use super::slip::Slip;
use crate::{
    diagnosis::{cause_names::DynamicsCause, hypothesis::FaultySide},
    side::Inertial,
};

const AXES: [&str; 3] = ["x", "y", "z"];

/// For each of the three coordinates, which of the right ones was written there.
const ORDERS: [(&str, [usize; 3]); 5] = [
    ("xy", [1, 0, 2]),
    ("xz", [2, 1, 0]),
    ("yz", [0, 2, 1]),
    ("cycle", [2, 0, 1]),
    ("cycle_back", [1, 2, 0]),
];

pub(super) fn slips<'a>(faulty: FaultySide) -> Vec<Slip<'a>> {
    let mut slips = Vec::new();
    let com = |parameters: &Inertial, com_m: Vector3<f64>| Inertial { com_m, ..*parameters };
    for (axis, name) in AXES.into_iter().enumerate() {
        slips.push(Slip::new(DynamicsCause::ComSign, name, move |parameters| {
            com(parameters, mirror(axis) * parameters.com_m)
        }));
    }
    slips
        .push(Slip::new(DynamicsCause::ComSign, "all", move |parameters| com(parameters, -parameters.com_m)));
    for (name, order) in ORDERS {
        slips.push(Slip::new(DynamicsCause::ComAxesSwapped, name, move |parameters| {
            com(parameters, reordered(faulty, order, &parameters.com_m))
        }));
    }
    for (axis, name) in AXES.into_iter().enumerate() {
        let mirror = mirror(axis);
        slips.push(Slip::new(DynamicsCause::Mirrored, name, move |parameters| {
            com(parameters, mirror * parameters.com_m)
                .with_tensor_in_link(&(mirror * parameters.tensor_in_link() * mirror))
        }));
    }
    slips
}

fn mirror(axis: usize) -> Matrix3<f64> {
    let mut mirror = Matrix3::identity();
    mirror[(axis, axis)] = -1.0;
    mirror
}

/// Numbers put into another order, or put back.
fn reordered(faulty: FaultySide, order: [usize; 3], numbers: &Vector3<f64>) -> Vector3<f64> {
    let mut result = Vector3::zeros();
    for (place, taken) in order.into_iter().enumerate() {
        match faulty {
            FaultySide::Candidate => result[taken] = numbers[place],
            FaultySide::Reference => result[place] = numbers[taken],
        }
    }
    result
}
