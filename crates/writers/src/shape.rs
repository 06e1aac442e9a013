//! Shapes as they are compared: sizes and poses, whatever file a mesh comes from.

use congruent_description::{Geometry, Shape};
use nalgebra::Isometry3;

/// The largest difference of two shapes, m (angles count as metres); infinite if they are of different kinds, colours or meshes.
pub(crate) fn difference_m(found: &Shape, expected: &Shape) -> f64 {
    if found.color_rgba != expected.color_rgba {
        return f64::INFINITY;
    }
    let size = match (&found.geometry, &expected.geometry) {
        (Geometry::Box { size_m: a }, Geometry::Box { size_m: b })
        | (Geometry::Ellipsoid { semi_axes_m: a }, Geometry::Ellipsoid { semi_axes_m: b }) => (a - b).amax(),
        (Geometry::Sphere { radius_m: a }, Geometry::Sphere { radius_m: b }) => (a - b).abs(),
        (
            Geometry::Cylinder { radius_m: a, length_m: c },
            Geometry::Cylinder { radius_m: b, length_m: d },
        ) => (a - b).abs().max((c - d).abs()),
        (Geometry::Mesh(a), Geometry::Mesh(b)) => {
            let is_alike = a.triangles == b.triangles && a.vertices_m.len() == b.vertices_m.len();
            let corners = a.vertices_m.iter().zip(&b.vertices_m).map(|(a, b)| (a - b).amax());
            if is_alike { corners.fold(0.0, f64::max) } else { f64::INFINITY }
        }
        _ => f64::INFINITY,
    };
    size.max(poses_apart(&found.link_from_shape, &expected.link_from_shape))
}

/// The larger of the distance of two frames, m, and their angle, rad.
pub(crate) fn poses_apart(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    // Twice the sine of half the angle: the arc cosine would lose half of the digits.
    let angle = 2.0 * (a.rotation.inverse() * b.rotation).imag().norm();
    (a.translation.vector - b.translation.vector).norm().max(angle)
}
