//! Mass, centre of mass and rotational inertia of a link, or of several that move as one.

use nalgebra::{Isometry3, Matrix3, SymmetricEigen, Translation3, UnitQuaternion, Vector3};

/// Inertia of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inertia {
    /// Mass, kg; may be zero for a frame.
    pub mass_kg: f64,
    /// Pose of the inertial frame in the link; its origin is the centre of mass.
    pub link_from_inertial: Isometry3<f64>,
    /// Rotational inertia about the centre of mass, in the axes of the inertial frame.
    pub tensor_kg_m2: Matrix3<f64>,
}

impl Inertia {
    /// Whether the tensor is 1 kg m^2 about every axis, the placeholder of many examples.
    pub fn is_example(&self) -> bool {
        self.tensor_kg_m2 == Matrix3::identity()
    }

    /// The tensor about the centre of mass in the axes of the link, kg m^2.
    pub fn tensor_in_link(&self) -> Matrix3<f64> {
        let turn = self.link_from_inertial.rotation.to_rotation_matrix();
        turn.matrix() * self.tensor_kg_m2 * turn.matrix().transpose()
    }

    /// The inertia of links that move as one, each with its pose in the body, in the axes of the body; zero if
    /// there are none. Source: the parallel axis theorem.
    pub fn sum_of_parts(parts: impl Iterator<Item = (Isometry3<f64>, Self)> + Clone) -> Self {
        // Adding zero makes the sum of nothing, which is -0.0, plain zero.
        let mass_kg = parts.clone().map(|(_, part)| part.mass_kg).sum::<f64>() + 0.0;
        let com = |(body_from_link, part): (Isometry3<f64>, Self)| {
            (body_from_link * part.link_from_inertial).translation.vector
        };
        let weighted = parts.clone().map(|part| part.1.mass_kg * com(part)).sum::<Vector3<f64>>();
        let com_in_body = if mass_kg > 0.0 { weighted / mass_kg } else { Vector3::zeros() };
        // Parallel axis theorem: I = R I_c R^T + m (|d|^2 1 - d d^T), with d from the common centre of mass to that of the part.
        let about_com = |part: (Isometry3<f64>, Self)| {
            let turn = (part.0.rotation * part.1.link_from_inertial.rotation).to_rotation_matrix();
            let shift = com(part) - com_in_body;
            let steiner = Matrix3::identity() * shift.norm_squared() - shift * shift.transpose();
            turn.matrix() * part.1.tensor_kg_m2 * turn.matrix().transpose() + part.1.mass_kg * steiner
        };
        let tensor = parts.map(about_com).sum::<Matrix3<f64>>();
        Self {
            mass_kg,
            link_from_inertial: Isometry3::from_parts(
                Translation3::from(com_in_body),
                UnitQuaternion::identity(),
            ),
            // Rounding may have made it asymmetric.
            tensor_kg_m2: (tensor + tensor.transpose()) * 0.5,
        }
    }
}

/// The principal moments of a tensor in ascending order.
pub fn principal_moments(tensor_kg_m2: &Matrix3<f64>) -> [f64; 3] {
    // Entries near the largest double overflow inside the solver, which then never ends.
    let largest = tensor_kg_m2.amax();
    if largest == 0.0 {
        return [0.0; 3];
    }
    let mut moments: [f64; 3] =
        SymmetricEigen::new(tensor_kg_m2.map(|entry| entry / largest)).eigenvalues.into();
    moments.sort_by(f64::total_cmp);
    moments.map(|moment| moment * largest)
}
