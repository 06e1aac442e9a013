//! Axis-aligned bounding boxes of shapes.

use nalgebra::{Point3, Vector3};

use super::{Geometry, Shape};

/// An axis-aligned box in the frame of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    least: Vector3<f64>,
    most: Vector3<f64>,
}

impl Extent {
    pub(crate) fn of_point(point: Vector3<f64>) -> Self {
        Self { least: point, most: point }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self { least: self.least.inf(&other.least), most: self.most.sup(&other.most) }
    }

    /// The same with a point in it.
    #[must_use]
    pub fn including(self, point: Vector3<f64>) -> Self {
        self.with(Self::of_point(point))
    }

    /// Around a shape in its own frame; `None` if it has no vertices.
    pub fn of_geometry(geometry: &Geometry) -> Option<Self> {
        let half = match geometry {
            Geometry::Box { size_m } => size_m / 2.0,
            Geometry::Cylinder { radius_m, length_m } => Vector3::new(*radius_m, *radius_m, length_m / 2.0),
            Geometry::Sphere { radius_m } => Vector3::repeat(*radius_m),
            Geometry::Ellipsoid { semi_axes_m } => *semi_axes_m,
            Geometry::Mesh(mesh) => {
                let points = mesh.vertices_m.iter().map(|vertex| Self::of_point(vertex.coords));
                return points.reduce(Self::with);
            }
        };
        Some(Self { least: -half, most: half })
    }

    /// Around a shape in the frame of its link.
    pub fn of_shape(shape: &Shape) -> Option<Self> {
        let own = Self::of_geometry(&shape.geometry)?;
        let corner =
            |corner: Vector3<f64>| Self::of_point((shape.link_from_shape * Point3::from(corner)).coords);
        own.corners().into_iter().map(corner).reduce(Self::with)
    }

    /// The eight corners in the frame of the box.
    pub fn corners(&self) -> [Vector3<f64>; 8] {
        std::array::from_fn(|at| {
            let pick = |axis: usize| if at >> axis & 1 == 0 { self.least[axis] } else { self.most[axis] };
            Vector3::new(pick(0), pick(1), pick(2))
        })
    }

    /// Length of the diagonal, m.
    pub fn diagonal_m(&self) -> f64 {
        (self.most - self.least).norm()
    }

    /// Volume, m^3. Each side counts as at least 0.1 mm, so that the density of a flat shape stays finite.
    pub fn volume_m3(&self) -> f64 {
        (self.most - self.least).map(|side| side.max(1e-4)).product()
    }

    /// Distance of a point from the box, 0 inside.
    pub fn distance_m(&self, point: Vector3<f64>) -> f64 {
        (self.least - point).sup(&(point - self.most)).map(|beyond| beyond.max(0.0)).norm()
    }

    /// The largest distance of a point of the box from the origin.
    pub fn farthest_m(&self) -> f64 {
        self.least.abs().sup(&self.most.abs()).norm()
    }
}
