//! Shapes of links. Units are metres; mesh files are read by crate `meshes`.

use std::sync::Arc;

use congruent_meshes::Mesh;
use nalgebra::{Isometry3, Translation3, Vector3};

/// One visual or collision element of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Pose of the shape's own frame in the link.
    pub link_from_shape: Isometry3<f64>,
    /// The shape in its own frame.
    pub geometry: Geometry,
    /// Colour, red, green, blue, alpha in 0 to 1, if the description gives one.
    pub color_rgba: Option<[f32; 4]>,
}

/// A shape in its own frame, centred on its origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// A box with edges along the axes.
    Box {
        /// Full edge lengths along x, y, z.
        size_m: Vector3<f64>,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius about the z axis, m.
        radius_m: f64,
        /// Full length along z.
        length_m: f64,
    },
    /// A sphere about the origin.
    Sphere {
        /// Radius of the sphere, m.
        radius_m: f64,
    },
    /// An ellipsoid about the origin, its axes along x, y, z.
    Ellipsoid {
        /// Half of its extent along x, y, z; each is above 0.
        semi_axes_m: Vector3<f64>,
    },
    /// A triangle mesh, shared by all shapes that use the same file and scale.
    Mesh(Arc<Mesh>),
}

impl Geometry {
    /// A capsule along z by parts, each with its pose in the capsule: a cylinder and a sphere at each end, so that distances are
    /// exact. `length_m` is that of the cylinder, as in `capsule_shape.sdf` of SDF 1.8; URDF 1.1 took the element over.
    pub fn capsule(radius_m: f64, length_m: f64) -> Vec<(Isometry3<f64>, Self)> {
        let end = |z: f64| (Translation3::new(0.0, 0.0, z).into(), Self::Sphere { radius_m });
        let middle = Self::Cylinder { radius_m, length_m };
        vec![(Isometry3::identity(), middle), end(-length_m / 2.0), end(length_m / 2.0)]
    }
}
