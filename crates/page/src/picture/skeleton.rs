//! An arm as lines, and shapes as points.

use congruent_description::{Geometry, Link, LinkIndex, Robot};
use nalgebra::{Isometry3, Point3, Vector3};

/// Most vertices of a mesh that are used for its outline, which has few corners. Kind: choice.
const MOST_VERTICES: usize = 300;
/// Corners of a circle.
const CORNERS: u32 = 16;

/// An arm as lines: from each link's frame to those of its children, with the axes of the joints that move.
#[derive(Debug, Clone)]
pub(crate) struct Skeleton {
    pub(crate) links: Vec<[Point3<f64>; 2]>,
    /// Where each moving joint is, and along which axis it moves.
    pub(crate) joints: Vec<(Point3<f64>, Vector3<f64>)>,
    pub(crate) tip: Isometry3<f64>,
}

impl Skeleton {
    /// The robot with its links at these poses.
    pub(crate) fn new(robot: &Robot, root_from_links: &[Isometry3<f64>], tip: LinkIndex) -> Self {
        let origin = |link: LinkIndex| Point3::from(root_from_links[link.get()].translation.vector);
        let links = robot.joints().iter().map(|joint| [origin(joint.parent), origin(joint.child)]);
        let joints = robot.movable_joints().iter().map(|&joint| {
            let joint = robot.joint(joint);
            (
                origin(joint.child),
                root_from_links[joint.child.get()].rotation * joint.axis_in_joint.into_inner(),
            )
        });
        Self { links: links.collect(), joints: joints.collect(), tip: root_from_links[tip.get()] }
    }
}

/// Points of each shape of the links, with the name of the link: of its collision shapes, or of its visual ones if it has
/// no others.
pub(crate) fn shapes<'a>(
    robot: &'a Robot,
    root_from_links: &[Isometry3<f64>],
) -> Vec<(&'a str, Vec<Point3<f64>>)> {
    let of_link = |(link, root_from_link): (&'a Link, &Isometry3<f64>)| {
        let shapes = if link.collisions.is_empty() { &link.visuals } else { &link.collisions };
        let points = shapes.iter().map(|shape| {
            (link.name.as_str(), corners(&shape.geometry, &(root_from_link * shape.link_from_shape)))
        });
        points.collect::<Vec<_>>()
    };
    robot.links().iter().zip(root_from_links).flat_map(of_link).collect()
}

/// Points whose outline is that of a shape.
pub(crate) fn corners(geometry: &Geometry, root_from_shape: &Isometry3<f64>) -> Vec<Point3<f64>> {
    let signs = [-0.5, 0.5];
    let circle = |radius_m: f64, z: f64| {
        let angles = (0..CORNERS).map(|k| std::f64::consts::TAU * f64::from(k) / f64::from(CORNERS));
        angles.map(move |angle| Point3::new(radius_m * libm::cos(angle), radius_m * libm::sin(angle), z))
    };
    let ball = |radius_m: f64| {
        let polar_angles =
            (0..=CORNERS / 2).map(|k| std::f64::consts::PI * f64::from(2 * k) / f64::from(CORNERS));
        polar_angles.flat_map(move |polar| circle(radius_m * libm::sin(polar), radius_m * libm::cos(polar)))
    };
    let points: Vec<Point3<f64>> = match geometry {
        Geometry::Box { size_m } => {
            let corner = |x: f64, y: f64, z: f64| Point3::new(x * size_m.x, y * size_m.y, z * size_m.z);
            let edges = |x| signs.into_iter().flat_map(move |y| signs.map(|z| corner(x, y, z)));
            signs.into_iter().flat_map(edges).collect()
        }
        Geometry::Cylinder { radius_m, length_m } => {
            signs.into_iter().flat_map(|side| circle(*radius_m, side * length_m)).collect()
        }
        Geometry::Sphere { radius_m } => ball(*radius_m).collect(),
        Geometry::Ellipsoid { semi_axes_m } => {
            ball(1.0).map(|point| point.coords.component_mul(semi_axes_m).into()).collect()
        }
        Geometry::Mesh(mesh) => {
            // Evenly through the list of vertices: the first of them could be those of one part of the shape.
            let every = mesh.vertices_m.len().div_ceil(MOST_VERTICES).max(1);
            mesh.vertices_m.iter().step_by(every).copied().collect()
        }
    };
    points.iter().map(|point| root_from_shape * point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipsoid_has_points_on_its_surface_and_at_the_ends_of_its_axes() {
        let semi_axes_m = Vector3::new(0.1, 0.2, 0.3);
        let place = Isometry3::translation(1.0, 2.0, 3.0);
        let points = corners(&Geometry::Ellipsoid { semi_axes_m }, &place);
        let in_shape: Vec<_> = points.iter().map(|point| point - place.translation.vector).collect();
        // Rounding of a sine, 1e-16.
        let is_on =
            |point: &Point3<f64>| (point.coords.component_div(&semi_axes_m).norm() - 1.0).abs() < 1e-12;
        assert!(in_shape.iter().all(is_on), "{in_shape:?}");
        for axis in 0..3 {
            let most = in_shape.iter().map(|point| point[axis]).fold(0.0, f64::max);
            assert!((most - semi_axes_m[axis]).abs() < 1e-12, "{axis}: {most}");
        }
    }
}
