//! The nearest inertia that a rigid body can have, for links that the robot file names.
//!
//! A body's principal moments are `s2 + s3`, `s3 + s1` and `s1 + s2` of its second moments `s`, which are not
//! negative; that alone makes them positive and keeps the triangle inequality. These moments are a convex cone.
//! The tensor that is nearest in the Frobenius norm has the same principal axes, and its principal moments are
//! the nearest point of the cone: both sets do not change under rotations. Source: Wensing, Kim, Slotine,
//! *Linear matrix inequalities for physically consistent inertial parameter identification* (2018), sec. III.

use std::{collections::BTreeMap, ops::Range, sync::Arc};

use congruent_input::SourceFile;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Smallest second moment of a repaired inertia, as a part of the largest principal moment in the file: a body
/// with no extent in a direction is possible, but physics divides by its moments.
const LEAST_SECOND_MOMENT: f64 = 1e-6;

/// The links whose inertia is to be repaired, with their places in the robot file.
#[derive(Debug, Default)]
pub(crate) struct Repairs {
    pub(crate) links: BTreeMap<String, Range<usize>>,
    /// The robot file; `None` if there is none.
    pub(crate) source: Option<Arc<SourceFile>>,
}

/// The nearest tensor in the Frobenius norm that a rigid body can have, kg m^2, about the same centre and in the same axes.
pub fn nearest_possible_tensor(tensor_kg_m2: &Matrix3<f64>) -> Matrix3<f64> {
    // Scaled to entries of at most 1: the eigenvalue solver overflows on entries near the largest double.
    let largest = tensor_kg_m2.amax();
    if largest == 0.0 {
        return *tensor_kg_m2;
    }
    let SymmetricEigen { eigenvectors, eigenvalues } =
        SymmetricEigen::new(tensor_kg_m2.map(|entry| entry / largest));
    // Moments s2 + s3 and so on with every s >= s_min are the cone shifted by 2 s_min along (1, 1, 1), so the projection runs
    // on shifted moments: the repaired body keeps a small extent in each direction, by which physics can divide.
    let floor = Vector3::repeat(2.0 * LEAST_SECOND_MOMENT * eigenvalues.amax());
    let moments = nearest_moments(eigenvalues - floor) + floor;
    let tensor = eigenvectors * Matrix3::from_diagonal(&moments) * eigenvectors.transpose();
    // Rounding makes the product slightly asymmetric, and solvers read only one triangle.
    (tensor + tensor.transpose()) * (0.5 * largest)
}

/// The nearest point of the cone of principal moments. The nearest point lies on a face that some set of the three edges
/// spans, so the least-squares solution of each set is tried, and the nearest one with coefficients >= 0 is the projection.
fn nearest_moments(moments: Vector3<f64>) -> Vector3<f64> {
    const EDGES: [[f64; 3]; 3] = [[0.0, 1.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0]];
    let mut best = Vector3::zeros();
    // The nearest point of the cone lies on one of its faces: of the projections onto the spans of all sets of edges
    // those with positive coordinates are in the cone, and the nearest one is the answer. The empty set is the zero
    // that `best` begins with.
    for set in 1_u8..8 {
        let edge = |index: usize| {
            if set >> index & 1 == 1 { Vector3::from(EDGES[index]) } else { Vector3::zeros() }
        };
        let edges = Matrix3::from_columns(&[edge(0), edge(1), edge(2)]);
        let Ok(inverse) = edges.pseudo_inverse(1e-12) else { continue };
        let second_moments = inverse * moments;
        let point = edges * second_moments;
        let is_inside = second_moments.iter().all(|moment| *moment >= 0.0);
        if is_inside && (point - moments).norm() < (best - moments).norm() {
            best = point;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::urdf::inertial::possible::Impossible;
    use congruent_robot::Inertia;

    /// Rounding of an eigenvalue problem of order 1; worst seen 1e-15.
    const ROUNDING: f64 = 1e-14;

    fn turned(moments: [f64; 3]) -> Matrix3<f64> {
        let turn = Rotation3::from_euler_angles(0.3, -0.2, 0.9);
        turn * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.inverse()
    }

    #[track_caller]
    fn check(moments: [f64; 3], expected: [f64; 3]) {
        let repaired = nearest_possible_tensor(&turned(moments));
        // The floor moves each principal moment by at most twice itself.
        let floor = 4.0 * LEAST_SECOND_MOMENT;
        assert!((repaired - turned(expected)).norm() < floor + ROUNDING, "{repaired}");
        let inertia = Inertia {
            mass_kg: 1.0,
            link_from_inertial: nalgebra::Isometry3::identity(),
            tensor_kg_m2: repaired,
        };
        assert_eq!(Impossible::find(&inertia), None);
        assert!(repaired.symmetric_eigenvalues().min() > 0.0, "{repaired}");
    }

    #[test]
    fn the_nearest_possible_moments() {
        // Inside: unchanged. One beyond the triangle inequality: along its normal (1, 1, -1) / sqrt(3).
        check([0.4, 0.5, 0.6], [0.4, 0.5, 0.6]);
        check([0.1, 0.2, 0.6], [0.2, 0.3, 0.5]);
        // On an edge: the projection of (-0.4, 0.1, 0.5) on (0, 1, 1).
        check([-0.4, 0.1, 0.5], [0.0, 0.3, 0.3]);
        check([-0.5, -0.5, -0.5], [0.0, 0.0, 0.0]);
    }

    /// No other possible tensor is nearer: a law, tried at many.
    #[test]
    fn nothing_possible_is_nearer() {
        let wrong = turned([-0.2, 0.1, 0.7]);
        let least = (nearest_possible_tensor(&wrong) - wrong).norm();
        let steps = || (0..12).map(|step| f64::from(step) * 0.1);
        for (a, b) in steps().flat_map(|a| steps().map(move |b| (a, b))) {
            for c in steps() {
                let distance = (turned([b + c, c + a, a + b]) - wrong).norm();
                assert!(distance > least - 4.0 * LEAST_SECOND_MOMENT, "{a} {b} {c}: {distance} < {least}");
            }
        }
    }
}
