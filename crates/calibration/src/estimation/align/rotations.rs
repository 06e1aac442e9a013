//! Rotations of base and tool in closed form.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::rows::AlignmentRow;

/// A projection shorter than this has no direction. No unit; kind: rounding.
const ROUNDING: f64 = 1e-9;

/// The rotation nearest to a matrix in the Frobenius norm: `U diag(1, 1, det(U V^T)) V^T`. Unlike the polar factor it is also
/// one for points in a plane, whose matrix is singular.
///
/// Source: Umeyama, *Least-squares estimation of transformation parameters between two point patterns* (1991), eq. 40.
pub(super) fn nearest(matrix: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let decomposition = matrix.svd(true, true);
    let (mut u, v_transposed) = (decomposition.u?, decomposition.v_t?);
    if (u * v_transposed).determinant() < 0.0 {
        // The singular values descend: the last direction is the one that costs least to turn around.
        let turned = -u.column(2);
        u.set_column(2, &turned);
    }
    Some(u * v_transposed)
}

/// The rotation `B` of the base from orientations, for a known rotation `T` of the tool: `M = B R T`.
pub(super) fn of_base(rows: &[AlignmentRow<'_>], of_tool: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let measured = orientations(rows);
    let sum = measured.iter().map(|(measured, nominal)| measured * (nominal * of_tool).transpose()).sum();
    (!measured.is_empty()).then(|| nearest(&sum)).flatten()
}

/// The rotation `T` of the tool from orientations, for a known rotation `B` of the base: `M = B R T`.
pub(super) fn of_tool(rows: &[AlignmentRow<'_>], of_base: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let measured = orientations(rows);
    let sum = measured.iter().map(|(measured, nominal)| (of_base * nominal).transpose() * measured).sum();
    (!measured.is_empty()).then(|| nearest(&sum)).flatten()
}

/// The rotation of the base from orientations alone, the tool unknown: the robot-world and hand-eye problem.
///
/// `M T^-1 = B R` for each row gives `vec(B) = (R kron M) vec(T^-1)`, so the two are singular vectors of the sum of `R kron M`, for
/// a singular value near the number of rows. Of several, as if all rows turn about one axis, that one is taken which
/// turns the tool least.
///
/// Source: Shah, *Solving the robot-world/hand-eye calibration problem using the Kronecker product*, Journal of Mechanisms and
/// Robotics 5 (2013), the solution for the rotations.
pub(super) fn of_both(rows: &[AlignmentRow<'_>], threshold: f64) -> Option<Matrix3<f64>> {
    let measured = orientations(rows);
    if measured.is_empty() {
        return None;
    }
    let kronecker = |(measured, nominal): &(Matrix3<f64>, Matrix3<f64>)| nominal.kronecker(measured);
    let sum: SMatrix<f64, 9, 9> = measured.iter().map(kronecker).sum();
    let decomposition = sum.svd(false, true);
    let (values, v_transposed) = (decomposition.singular_values, decomposition.v_t?);
    let nominal_tool = SVector::<f64, 9>::from_column_slice(Matrix3::<f64>::identity().as_slice());
    // Rows that turn by an angle e lower a singular value by the share e^2 / 2.
    let is_solution = |value: f64| value >= values[0] * (1.0 - threshold * threshold);
    let solutions = values.iter().take_while(|value| is_solution(**value)).count();
    let vector = |at: usize| v_transposed.row(at).transpose();
    let nearest_solution: SVector<f64, 9> =
        (0..solutions).map(|at| vector(at) * vector(at).dot(&nominal_tool)).sum();
    // A tool that is turned by 120 degrees has no product with the nominal one: a single solution is taken as it is.
    let is_unique = solutions == 1 || nearest_solution.norm() < ROUNDING;
    let inverse_tool = if is_unique { vector(0) } else { nearest_solution };
    // A singular vector has no sign; a rotation has a positive determinant.
    let inverse_tool = Matrix3::from_column_slice(inverse_tool.as_slice());
    let inverse_tool = if inverse_tool.determinant() < 0.0 { -inverse_tool } else { inverse_tool };
    of_base(rows, &nearest(&inverse_tool)?.transpose())
}

/// The rotation of the base from points, as if the target were at the tip.
///
/// Source: Umeyama (1991), eq. 40, without scale.
pub(super) fn of_points(rows: &[AlignmentRow<'_>]) -> Option<Matrix3<f64>> {
    let (measured, nominal): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) =
        rows.iter().filter_map(|row| Some((row.point()?, row.base_from_tip.translation))).unzip();
    if measured.is_empty() {
        return None;
    }
    let (measured_mean, nominal_mean) = (mean(&measured), mean(&nominal));
    let pairs = measured.iter().zip(&nominal);
    let covariance: Matrix3<f64> = pairs
        .map(|(measured, nominal)| (measured - measured_mean) * (nominal - nominal_mean).transpose())
        .sum();
    nearest(&covariance)
}

fn mean(points: &[Vector3<f64>]) -> Vector3<f64> {
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
    let count = points.len() as f64;
    points.iter().sum::<Vector3<f64>>() / count
}

/// The measured orientations, each with that of the nominal tip.
fn orientations(rows: &[AlignmentRow<'_>]) -> Vec<(Matrix3<f64>, Matrix3<f64>)> {
    rows.iter().filter_map(|row| Some((row.measured.base_from_tip?, row.base_from_tip.rotation))).collect()
}
