//! Principal moments, and which of them a body can have.

use nalgebra::{Matrix3, Vector3};

/// Principal moments of an inertia, in ascending order unless it is diagonal.
pub(crate) fn moments(inertia: &Matrix3<f64>) -> Vector3<f64> {
    let is_diagonal = inertia.upper_triangle() == inertia.lower_triangle();
    // A diagonal is kept bit for bit: MuJoCo compares the moments as they are written.
    if is_diagonal { inertia.diagonal() } else { inertia.symmetric_eigenvalues() }
}

/// Whether no moment exceeds the sum of the other two by more than `slack`. As MuJoCo, in the arithmetic of 64 bits.
pub(crate) fn is_possible(moments: &Vector3<f64>, slack: f64) -> bool {
    let [a, b, c] = [moments.x, moments.y, moments.z];
    a + b + slack >= c && a + c + slack >= b && b + c + slack >= a
}

/// The inertia with its principal moments changed, about the same axes.
pub(super) fn with_moments(
    inertia: &Matrix3<f64>,
    change: impl FnOnce(Vector3<f64>) -> Vector3<f64>,
) -> Matrix3<f64> {
    if inertia.upper_triangle() == inertia.lower_triangle() {
        return Matrix3::from_diagonal(&change(inertia.diagonal()));
    }
    let principal = inertia.symmetric_eigen();
    let axes = principal.eigenvectors;
    axes * Matrix3::from_diagonal(&change(principal.eigenvalues)) * axes.transpose()
}

/// Inertia about a point that is `offset` from the centre of mass: the parallel axis theorem.
pub(super) fn shifted(about_center: &Matrix3<f64>, mass: f64, offset: &Vector3<f64>) -> Matrix3<f64> {
    about_center + from_covariance(&(offset * offset.transpose())) * mass
}

/// The inertia of a second moment of mass: `tr(C) 1 - C`.
pub(super) fn from_covariance(covariance: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::identity() * covariance.trace() - covariance
}
