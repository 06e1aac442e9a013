//! The one place that names parry: convex hulls and exact distances between them.
//!
//! Meshes are taken as their convex hulls, which contain them: a distance between hulls is never
//! larger than the distance between the meshes.

use congruent_description::{Geometry, Shape};
use nalgebra::{Isometry3, Point3};
use parry3d_f64::{
    math::{Pose, Rotation, Vector},
    query::{self, Unsupported},
    shape::{Ball, ConvexPolyhedron, Cuboid, Cylinder, SharedShape},
};

/// Why a shape has no hull.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProximityError {
    /// All vertices lie in a plane, on a line or in a point.
    #[error("{subject}: the mesh has no volume, so it has no convex hull")]
    Flat {
        /// The link or obstacle.
        subject: String,
    },
}

/// The collision shapes of one link or obstacle, ready for distance queries.
#[derive(Clone)]
pub struct Hulls {
    shapes: Vec<(Pose, SharedShape)>,
    radius_m: f64,
}

impl std::fmt::Debug for Hulls {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Hulls").field("shapes", &self.shapes.len()).field("radius_m", &self.radius_m).finish()
    }
}

impl Hulls {
    /// Hulls of the shapes of one link; a mesh without triangles contributes nothing.
    ///
    /// # Errors
    /// [`ProximityError::Flat`] when a mesh has no volume.
    pub fn new(subject: &str, shapes: &[Shape]) -> Result<Self, ProximityError> {
        let mut hulls = Self { shapes: Vec::with_capacity(shapes.len()), radius_m: 0.0 };
        for shape in shapes {
            let Some(Convex { shape_from_local, form, radius_m }) = convex(subject, &shape.geometry)? else {
                continue;
            };
            let link_from_hull = pose(&shape.link_from_shape) * shape_from_local;
            hulls.radius_m = hulls.radius_m.max(link_from_hull.translation.length() + radius_m);
            hulls.shapes.push((link_from_hull, form));
        }
        Ok(hulls)
    }

    /// Whether there is nothing to touch.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Radius of a ball about the link's origin that contains every shape.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    /// Distance to other hulls that stand at pose `self_from_other`; 0 where they touch or overlap.
    pub fn distance_m(&self, other: &Self, self_from_other: &Isometry3<f64>) -> f64 {
        self.smallest(other, self_from_other, |between, a, b| {
            query::distance(&Pose::IDENTITY, a, between, b).map(|nearest| nearest.distance)
        })
    }

    /// Like [`Hulls::distance_m`], but negative where they overlap: minus the depth.
    pub fn signed_distance_m(&self, other: &Self, self_from_other: &Isometry3<f64>) -> f64 {
        self.smallest(other, self_from_other, |between, a, b| {
            let apart = query::distance(&Pose::IDENTITY, a, between, b)?.distance;
            if apart > 0.0 {
                return Ok(apart);
            }
            let contact = query::contact(&Pose::IDENTITY, a, between, b, 0.0)?;
            Ok(contact.map_or(0.0, |contact| contact.dist.min(0.0)))
        })
    }

    fn smallest(
        &self,
        other: &Self,
        self_from_other: &Isometry3<f64>,
        distance: impl Fn(
            &Pose,
            &dyn parry3d_f64::shape::Shape,
            &dyn parry3d_f64::shape::Shape,
        ) -> Result<f64, Unsupported>,
    ) -> f64 {
        let self_from_other = pose(self_from_other);
        let mut smallest = f64::INFINITY;
        for (self_from_a, a) in &self.shapes {
            for (other_from_b, b) in &other.shapes {
                let a_from_b = self_from_a.inv_mul(&(self_from_other * *other_from_b));
                let apart = distance(&a_from_b, &**a, &**b)
                    .expect("parry answers for every pair of boxes, balls, cylinders and hulls");
                smallest = smallest.min(apart);
            }
        }
        smallest
    }
}

/// A convex shape with the radius of a ball about its own origin that contains it.
struct Convex {
    shape_from_local: Pose,
    form: SharedShape,
    radius_m: f64,
}

fn convex(subject: &str, geometry: &Geometry) -> Result<Option<Convex>, ProximityError> {
    let mut shape_from_local = Pose::IDENTITY;
    let (form, radius_m) = match geometry {
        Geometry::Box { size_m } => {
            let half = Vector::new(size_m.x / 2.0, size_m.y / 2.0, size_m.z / 2.0);
            (SharedShape::new(Cuboid::new(half)), half.length())
        }
        Geometry::Cylinder { radius_m, length_m } => {
            // parry's cylinder stands along y, the description's along z.
            shape_from_local =
                Pose::from_parts(Vector::ZERO, Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2));
            let upright = SharedShape::new(Cylinder::new(length_m / 2.0, *radius_m));
            (upright, radius_m.hypot(length_m / 2.0))
        }
        Geometry::Sphere { radius_m } => (SharedShape::new(Ball::new(*radius_m)), *radius_m),
        Geometry::Mesh(mesh) if mesh.triangles.is_empty() => return Ok(None),
        Geometry::Mesh(mesh) => {
            let flat = || ProximityError::Flat { subject: subject.to_owned() };
            let points: Vec<Vector> = mesh.vertices_m.iter().map(vector).collect();
            let hull = ConvexPolyhedron::from_convex_hull(&points).ok_or_else(flat)?;
            let radius_m = hull.points().iter().map(|point| point.length()).fold(0.0, f64::max);
            (SharedShape::new(hull), radius_m)
        }
    };
    Ok(Some(Convex { shape_from_local, form, radius_m }))
}

fn vector(point: &Point3<f64>) -> Vector {
    Vector::new(point.x, point.y, point.z)
}

fn pose(isometry: &Isometry3<f64>) -> Pose {
    let (shift, turn) = (&isometry.translation, isometry.rotation.coords);
    Pose::from_parts(
        Vector::new(shift.x, shift.y, shift.z),
        Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w),
    )
}
