//! The pseudo-inertia of a body: the 4 x 4 matrix that is positive definite for every body that can exist, and for no other.
//!
//! Source: Wensing, Kim, Slotine, *Linear matrix inequalities for physically consistent inertial parameter identification* (2018).

use congruent_dynamics::{PARAMETERS, SpatialInertia};
use nalgebra::{Matrix4, SMatrix, SVector};

/// The ten inertial parameters of a body, in the order of [`SpatialInertia::parameters`].
pub(crate) type Parameters = SVector<f64, PARAMETERS>;

/// The pseudo-inertia: the second moments of the mass in the upper left, the first moments beside them, the mass in the corner.
pub(crate) fn pseudo_inertia(parameters: &Parameters) -> Matrix4<f64> {
    let inertia = SpatialInertia::from_parameters((*parameters).into());
    let tensor = inertia.tensor_kg_m2;
    let mut matrix = Matrix4::zeros();
    let half_trace = tensor.trace() / 2.0;
    for row in 0..3 {
        for column in 0..3 {
            let diagonal = if row == column { half_trace } else { 0.0 };
            matrix[(row, column)] = diagonal - tensor[(row, column)];
        }
        matrix[(row, 3)] = inertia.first_moment_kg_m[row];
        matrix[(3, row)] = inertia.first_moment_kg_m[row];
    }
    matrix[(3, 3)] = inertia.mass_kg;
    matrix
}

/// The parameters of a pseudo-inertia.
pub(crate) fn parameters(pseudo: &Matrix4<f64>) -> Parameters {
    let moments = pseudo.fixed_view::<3, 3>(0, 0);
    let tensor = nalgebra::Matrix3::identity() * moments.trace() - moments;
    let inertia = SpatialInertia {
        mass_kg: pseudo[(3, 3)],
        first_moment_kg_m: pseudo.fixed_view::<3, 1>(0, 3).into_owned(),
        tensor_kg_m2: tensor,
    };
    inertia.parameters().into()
}

/// Whether a body with these parameters can exist.
pub(crate) fn is_body(parameters: &Parameters) -> bool {
    let pseudo = pseudo_inertia(parameters);
    pseudo.trace() > 0.0 && pseudo.cholesky().is_some()
}

/// The metric of inertial parameters about those of a body, in which a change of all its masses by the factor `1 + e` has the
/// square `e^2`; it is the same in every frame and in every unit.
///
/// Source: Lee, Wensing, Park, *Geometric robot dynamic identification: a convex programming approach* (2020), eq. 26, divided
/// by four. `None` if the body cannot exist.
pub(crate) fn metric(about: &Parameters) -> Option<SMatrix<f64, PARAMETERS, PARAMETERS>> {
    let inverse = pseudo_inertia(about).cholesky()?.inverse();
    let directions: [Matrix4<f64>; PARAMETERS] = std::array::from_fn(|at| {
        let mut unit = Parameters::zeros();
        unit[at] = 1.0;
        inverse * pseudo_inertia(&unit)
    });
    Some(SMatrix::from_fn(|row, column| (directions[row] * directions[column]).trace() / 4.0))
}

/// A body as the triangle `L` of its pseudo-inertia `L L^T`: whatever its ten numbers are, the body can exist.
///
/// Source: Burer, Monteiro, *A nonlinear programming algorithm for solving semidefinite programs via low-rank factorization* (2003).
#[derive(Debug, Clone)]
pub(crate) struct Triangle(Matrix4<f64>);

impl Triangle {
    /// `None` if the body cannot exist.
    pub(crate) fn of(body: &Parameters) -> Option<Self> {
        Some(Self(pseudo_inertia(body).cholesky()?.l()))
    }

    pub(crate) fn parameters(&self) -> Parameters {
        parameters(&(self.0 * self.0.transpose()))
    }

    /// Derivatives of the parameters by the ten numbers.
    pub(crate) fn jacobian(&self) -> SMatrix<f64, PARAMETERS, PARAMETERS> {
        let mut jacobian = SMatrix::<f64, PARAMETERS, PARAMETERS>::zeros();
        for (at, place) in places().enumerate() {
            let mut unit = Matrix4::zeros();
            unit[place] = 1.0;
            let change = unit * self.0.transpose();
            jacobian.set_column(at, &parameters(&(change + change.transpose())));
        }
        jacobian
    }

    /// Second derivatives, by the ten numbers, of a sum that has this gradient by the parameters, as far as they come from the product
    /// `L L^T`.
    pub(crate) fn curvature(gradient: &Parameters) -> SMatrix<f64, PARAMETERS, PARAMETERS> {
        let mut curvature = SMatrix::<f64, PARAMETERS, PARAMETERS>::zeros();
        for (at, (row, column)) in places().enumerate() {
            // Units of two columns have no product.
            for (to, (other_row, _)) in places().enumerate().filter(|(_, of)| of.1 == column) {
                let mut product = Matrix4::zeros();
                product[(row, other_row)] += 1.0;
                product[(other_row, row)] += 1.0;
                curvature[(at, to)] = gradient.dot(&parameters(&product));
            }
        }
        curvature
    }

    /// The body after a step in the ten numbers.
    pub(crate) fn stepped(&self, step: &[f64]) -> Self {
        let mut triangle = self.0;
        for (place, step) in places().zip(step) {
            triangle[place] += step;
        }
        Self(triangle)
    }
}

/// The places of the ten numbers in the triangle.
fn places() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|row| (0..=row).map(move |column| (row, column)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// Two balls: a body with an extension.
    fn body() -> Parameters {
        let corners = [[0.1, 0.0, 0.2], [0.0, 0.3, 0.0], [-0.1, 0.1, 0.1], [0.2, 0.2, -0.1]];
        let sum = corners.iter().map(|at| SpatialInertia::point_mass(0.7, Vector3::from(*at)));
        sum.fold(SpatialInertia::zero(), |sum, one| sum + one).parameters().into()
    }

    #[test]
    fn parameters_are_those_of_their_pseudo_inertia() {
        let body = body();
        assert!((parameters(&pseudo_inertia(&body)) - body).amax() < 1e-15);
        assert!((Triangle::of(&body).unwrap().parameters() - body).amax() < 1e-15);
    }

    #[test]
    fn a_body_whose_moments_break_the_triangle_inequality_cannot_exist() {
        let mut thin = body();
        assert!(is_body(&thin));
        thin[0] = 10.0 * (thin[3] + thin[5]);
        assert!(!is_body(&thin));
    }

    #[test]
    fn the_metric_of_a_heavier_body_is_the_square_of_the_factor() {
        let body = body();
        let metric = metric(&body).unwrap();
        let change = body * 0.1;
        assert!(((change.transpose() * metric * change)[0] - 0.01).abs() < 1e-12);
    }

    #[test]
    fn the_jacobian_of_the_triangle_is_that_of_differences() {
        let triangle = Triangle::of(&body()).unwrap();
        let jacobian = triangle.jacobian();
        for at in 0..PARAMETERS {
            let mut step = [0.0; PARAMETERS];
            step[at] = 1e-6;
            let changed = (triangle.stepped(&step).parameters() - triangle.parameters()) / 1e-6;
            assert!((changed - jacobian.column(at)).amax() < 1e-5, "{at}");
        }
    }
}
