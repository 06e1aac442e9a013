//! The free parameters of one link, which are fitted if no mistake without free parameters explains the difference.

use congruent_dynamics::{PARAMETERS, SpatialInertia};
use congruent_kinematics::rotation_exp;
use nalgebra::{Matrix3, Vector3};

use crate::{
    model::{Inertial, inertial::TenNumbers},
    thresholds::{QUADRATIC_STEP, ROTATION_STEP_RAD},
};

/// Which parameters of a link are free; their values are added to the written ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FreeParameters {
    Mass,
    /// One factor of mass and tensor.
    Density,
    ComEntry(usize),
    Com,
    /// One entry of the tensor as it is written.
    InertiaEntry(usize, usize),
    InertiaScale,
    Products,
    Inertia,
    /// All ten parameters, about the origin.
    Inertial,
    /// A point mass and its position in the link.
    Payload,
    /// The axes of the tensor, starting from this rotation.
    Rotation(Matrix3<f64>),
}

/// Entries of a symmetric tensor, in the order of the ten parameters.
pub(super) const ENTRIES: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
const PRODUCTS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

impl FreeParameters {
    pub(super) fn count(self) -> usize {
        match self {
            Self::Mass | Self::Density | Self::ComEntry(_) | Self::InertiaEntry(..) | Self::InertiaScale => 1,
            Self::Com | Self::Products | Self::Rotation(_) => 3,
            Self::Payload => 4,
            Self::Inertia => 6,
            Self::Inertial => PARAMETERS,
        }
    }

    /// The link's inertia about its origin with these values of the free parameters.
    pub(super) fn about_origin(self, written: &Inertial, x: &[f64]) -> SpatialInertia {
        match self {
            Self::Payload => {
                written.about_origin() + SpatialInertia::point_mass(x[0], Vector3::new(x[1], x[2], x[3]))
            }
            Self::Inertial => {
                let mut numbers = written.about_origin().parameters();
                numbers.iter_mut().zip(x).for_each(|(number, x)| *number += x);
                SpatialInertia::from_parameters(numbers)
            }
            _ => self.parameters(written, x).about_origin(),
        }
    }

    /// The link's written form of the parameters with these values of the free ones.
    pub(super) fn parameters(self, written: &Inertial, x: &[f64]) -> Inertial {
        let mut parameters = *written;
        let add = |tensor: &mut Matrix3<f64>, entries: &[(usize, usize)]| {
            for (&(row, column), x) in entries.iter().zip(x) {
                tensor[(row, column)] += x;
                // The entry is one parameter of a symmetric tensor: both halves move together.
                if row != column {
                    tensor[(column, row)] += x;
                }
            }
        };
        match self {
            Self::Mass => parameters.mass_kg += x[0],
            Self::Density => {
                parameters.mass_kg *= 1.0 + x[0];
                parameters.tensor_kg_m2 *= 1.0 + x[0];
            }
            Self::ComEntry(axis) => parameters.com_m[axis] += x[0],
            Self::Com => parameters.com_m += Vector3::new(x[0], x[1], x[2]),
            Self::InertiaEntry(row, column) => add(&mut parameters.tensor_kg_m2, &[(row, column)]),
            Self::InertiaScale => parameters.tensor_kg_m2 *= 1.0 + x[0],
            Self::Products => add(&mut parameters.tensor_kg_m2, &PRODUCTS),
            Self::Inertia => add(&mut parameters.tensor_kg_m2, &ENTRIES),
            Self::Rotation(start) => {
                let turn = rotation_exp(&Vector3::new(x[0], x[1], x[2])) * start;
                let tensor = turn * written.tensor_in_link() * turn.transpose();
                parameters = parameters.with_tensor_in_link(&tensor);
            }
            Self::Payload | Self::Inertial => {
                parameters = Inertial::from_origin(&self.about_origin(written, x), written.link_from_axes);
            }
        }
        parameters
    }

    /// Derivatives of the ten parameters by the free ones: exact, except for a rotation.
    pub(super) fn derivatives(self, written: &Inertial, x: &[f64]) -> Vec<TenNumbers> {
        let step = if matches!(self, Self::Rotation(_)) { ROTATION_STEP_RAD } else { QUADRATIC_STEP };
        let at = |entry: usize, by: f64| -> TenNumbers {
            let mut moved = x.to_vec();
            moved[entry] += by;
            self.about_origin(written, &moved).parameters().into()
        };
        // Central difference (f(x + h) - f(x - h)) / 2h: for a quadratic the error term, the third derivative, is
        // zero.
        (0..self.count()).map(|entry| (at(entry, step) - at(entry, -step)) / (2.0 * step)).collect()
    }
}
