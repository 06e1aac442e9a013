//! The one file that converts types: nalgebra outside, glam inside rapier.

use congruent_description::Inertia;
use nalgebra::{Isometry3, Point3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};
use rapier3d_f64::prelude::{MassProperties, Pose, Rotation, Vector};

/// Principal inertias below this part of the largest are raised to it.
///
/// rapier keeps the inverse of the inertia and inverts it in every step. That costs
/// `eps / ratio` of the largest inertia in rounding, the floor costs `ratio`: equal at `sqrt(eps)`.
/// Dimensionless; no robot of the corpus reaches it.
const SMALLEST_PRINCIPAL_RATIO: f64 = 1e-8;

pub(crate) fn vector(vector: &Vector3<f64>) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}

pub(crate) fn vector3(vector: Vector) -> Vector3<f64> {
    Vector3::new(vector.x, vector.y, vector.z)
}

pub(crate) fn points(points: &[Point3<f64>]) -> Vec<Vector> {
    points.iter().map(|point| vector(&point.coords)).collect()
}

fn rotation(rotation: &UnitQuaternion<f64>) -> Rotation {
    Rotation::from_xyzw(rotation.i, rotation.j, rotation.k, rotation.w)
}

pub(crate) fn pose(isometry: &Isometry3<f64>) -> Pose {
    Pose::from_parts(vector(&isometry.translation.vector), rotation(&isometry.rotation))
}

/// The pose as it is: rapier's quaternions are products of unit quaternions, unit to rounding.
pub(crate) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let (t, r) = (pose.translation, pose.rotation);
    // Normalising again would change last bits, and poses of equal states would differ from rapier's.
    let rotation = UnitQuaternion::new_unchecked(Quaternion::new(r.w, r.x, r.y, r.z));
    Isometry3::from_parts(Translation3::new(t.x, t.y, t.z), rotation)
}

/// A rotation that turns x, the axis of every joint in rapier, into `axis`.
///
/// By the half vector, which is exact to rounding for any axis; rapier's own helper takes axes
/// nearer than 3e-8 rad to x for x.
pub(crate) fn x_onto(axis: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    // Half vectors of nearly opposite directions are short and lose digits: turn by pi about z first, then it is at
    // most 90 deg.
    let (start, turn) = if axis.x < 0.0 {
        let half_turn_about_z = Quaternion::new(0.0, 0.0, 0.0, 1.0);
        (-Vector3::x(), UnitQuaternion::new_unchecked(half_turn_about_z))
    } else {
        (Vector3::x(), UnitQuaternion::identity())
    };
    let half = (start + axis.into_inner()).normalize();
    let arc = Quaternion::from_parts(start.dot(&half), start.cross(&half));
    UnitQuaternion::from_quaternion(arc) * turn
}

/// Mass properties by our own diagonalisation: rapier's returns arbitrary axes if the
/// principal inertias differ by less than about 1e-5 kg m^2.
pub(crate) fn mass_properties(inertia: &Inertia) -> MassProperties {
    let eigen = inertia.tensor_kg_m2.symmetric_eigen();
    let mut axes = eigen.eigenvectors;
    // Eigenvectors may be left-handed, which no quaternion represents.
    if axes.determinant() < 0.0 {
        axes.column_mut(2).neg_mut();
    }
    let floor = eigen.eigenvalues.amax() * SMALLEST_PRINCIPAL_RATIO;
    // Tiny negative values are rounding of a thin rod or plate; large ones are wrong input and stay visible.
    let principal = eigen.eigenvalues.map(|value| if value.abs() < floor { floor } else { value });
    let frame = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    MassProperties::with_principal_inertia_frame(
        vector(&inertia.link_from_inertial.translation.vector),
        inertia.mass_kg,
        vector(&principal),
        rotation(&frame),
    )
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;

    use super::*;

    /// A product of a few unit quaternions and vectors; rounding, 8 eps; worst seen 3.4e-16.
    const ROUNDING: f64 = 2e-15;

    #[test]
    fn x_is_turned_onto_any_axis() {
        let axes = [
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0],
            [1.0, 1e-8, 0.0],
            [-1.0, 0.0, -1e-8],
            [-0.3, 0.5, 0.7],
        ];
        for axis in axes.map(|axis| Unit::new_normalize(Vector3::from(axis))) {
            let turned = x_onto(&axis) * Vector3::x();
            assert!((turned - axis.into_inner()).amax() < ROUNDING, "{axis:?}: {turned:?}");
        }
    }

    #[test]
    fn a_pose_survives_the_round_trip() {
        let there = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::new(0.1, -0.2, 0.3));
        assert_eq!(isometry(&pose(&there)), there);
    }

    #[test]
    fn nearly_equal_principal_inertias_keep_their_axes() {
        let frame = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1).to_rotation_matrix();
        let principal = Matrix3::from_diagonal(&Vector3::new(1e-6, 2e-6, 2.5e-6));
        let tensor_kg_m2 = frame.matrix() * principal * frame.matrix().transpose();
        let inertia = Inertia { mass_kg: 0.1, link_from_inertial: Isometry3::identity(), tensor_kg_m2 };
        let back = mass_properties(&inertia).reconstruct_inertia_matrix();
        for (row, column) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
            let error = back.col(column)[row] - tensor_kg_m2[(row, column)];
            assert!(error.abs() < ROUNDING * 2.5e-6, "({row}, {column}): {error}");
        }
    }
}
