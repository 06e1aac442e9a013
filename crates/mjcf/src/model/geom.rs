//! Geoms, meshes and sites.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use super::written::{MjName, MjPlace, MjWritten};

/// A shape; sizes in m.
#[derive(Debug, Clone, PartialEq)]
pub enum MjShape {
    /// An infinite plane, normal to z.
    Plane,
    /// A height field.
    HeightField,
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A cylinder along z with half spheres at its ends.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half the length of the cylinder.
        half_length: f64,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half the length.
        half_length: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Half axes.
        radii: [f64; 3],
    },
    /// A box.
    Box {
        /// Half edges.
        half_sizes: [f64; 3],
    },
    /// A mesh, in its own frame: MuJoCo moves its frame to the centre, not its triangles.
    Mesh {
        /// Index in [`MjModel::meshes`](super::MjModel).
        mesh: usize,
    },
    /// A primitive that is fitted to a mesh, or a signed distance field: its sizes are not known.
    Fitted {
        /// The type, as `box`.
        kind: String,
        /// Index in [`MjModel::meshes`](super::MjModel), if it names one.
        mesh: Option<usize>,
    },
}

/// What gives the mass of a geom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MjGeomMass {
    /// Mass, kg.
    Mass(f64),
    /// Density, kg/m^3, or kg/m^2 if the mass is at the surface.
    Density(f64),
}

/// A geom: a shape that is drawn, collides or has mass.
#[derive(Debug, Clone, PartialEq)]
pub struct MjGeom {
    /// Name; empty if the file has none.
    pub name: String,
    /// Its body.
    pub body: usize,
    /// Its shape.
    pub shape: MjShape,
    /// Its pose in the body, frames included, m.
    pub body_from_geom: Isometry3<f64>,
    /// What gives its mass.
    pub mass: MjWritten<MjGeomMass>,
    /// Whether its mass is at the surface; only for primitives.
    pub is_shell: bool,
    /// Its group: by custom 2 is visual and 3 is collision, and the compiler may leave groups out of inertias.
    pub group: i32,
    /// Bits of contacts; a geom with none of both is only drawn.
    pub contact_type: i32,
    /// Bits of contacts with which it collides.
    pub contact_affinity: i32,
    /// Colour of its own: red, green, blue, opacity.
    pub rgba: Option<[f64; 4]>,
    /// Name of its material.
    pub material: Option<String>,
    /// The opening of its tag.
    pub place: MjPlace,
}

/// How the inertia of a mesh is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjMeshInertia {
    /// Of its convex hull.
    Convex,
    /// Of the volume that its triangles enclose, signed: exact for a closed surface.
    Exact,
    /// The sum of the pyramids on its triangles as MuJoCo sums them: too large for a mesh that is not convex.
    Legacy,
    /// Of its surface.
    Shell,
}

/// A mesh that geoms may use.
#[derive(Debug, Clone, PartialEq)]
pub struct MjMesh {
    /// Name; that of the file without folder and ending if none is given.
    pub name: String,
    /// Path of the file, relative to the folder of the main file unless it is absolute; `None` if the vertices are inline or
    /// built in.
    pub file: Option<MjWritten<String>>,
    /// Vertices that are given inline, before scale.
    pub vertices: Vec<Point3<f64>>,
    /// Triangles of them; if there are none, the mesh is the convex hull.
    pub faces: Vec<[usize; 3]>,
    /// Scale along each axis, m per unit of the file; may be negative.
    pub scale: MjWritten<Vector3<f64>>,
    /// What is subtracted from the vertices of the file, in its unit.
    pub reference_pos: Vector3<f64>,
    /// Its inverse turns the vertices, after the subtraction and before the scale.
    pub reference_orientation: UnitQuaternion<f64>,
    /// How its inertia is computed.
    pub inertia: MjMeshInertia,
    /// The opening of its tag.
    pub place: MjPlace,
}

impl MjMesh {
    /// A vertex of the file in the frame of the mesh, m.
    pub fn vertex(&self, in_file: Point3<f64>) -> Point3<f64> {
        let turned =
            self.reference_orientation.inverse_transform_vector(&(in_file.coords - self.reference_pos));
        Point3::from(turned.component_mul(&self.scale.value))
    }
}

/// A site: a named frame of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct MjSite {
    /// Name; `site 2 of forearm` if the file has none. A body may have the same name.
    pub name: MjName,
    /// Its body.
    pub body: usize,
    /// Its pose in the body, frames included, m.
    pub body_from_site: Isometry3<f64>,
    /// The opening of its tag.
    pub place: MjPlace,
}
