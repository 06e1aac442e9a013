//! The shapes of one link or obstacle in rerun's terms: all boxes, all cylinders and all spheres
//! stand at the body's own path, each mesh at one below it.

use congruent_description::{Geometry, Mesh, Shape};
use nalgebra::{Isometry3, Vector3};
use re_log_types::{EntityPath, EntityPathPart};
use re_sdk_types::{
    AsComponents, SerializedComponentBatch,
    archetypes::{Boxes3D, Cylinders3D, Ellipsoids3D, Mesh3D},
    components::{AlbedoFactor, Color, FillMode, TriangleIndices},
    datatypes::Quaternion,
};

/// An inset takes at most this part of a shape's thickness.
const THINNEST: f64 = 0.1;

/// Shapes of one kind: where each stands in the body, its colour, its measures.
#[derive(Debug)]
struct Placed<M> {
    centers: Vec<[f32; 3]>,
    quaternions: Vec<Quaternion>,
    colors: Vec<Color>,
    measures: Vec<M>,
}

impl<M> Placed<M> {
    fn new() -> Self {
        Self { centers: Vec::new(), quaternions: Vec::new(), colors: Vec::new(), measures: Vec::new() }
    }

    fn push(&mut self, body_from_shape: &Isometry3<f64>, color: Color, measures: M) {
        self.centers.push(vector(&body_from_shape.translation.vector));
        self.quaternions.push(quaternion(body_from_shape));
        self.colors.push(color);
        self.measures.push(measures);
    }
}

/// A mesh in the body's frame.
#[derive(Debug)]
struct PlacedMesh {
    archetype: Mesh3D,
    color: Color,
}

/// How a body is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Paint {
    /// In the colours of its description.
    Own,
    /// In one colour.
    Plain(Color),
}

/// A link or an obstacle, ready to be logged.
#[derive(Debug)]
pub(super) struct Body {
    boxes: Placed<[f32; 3]>,
    cylinders: Placed<(f32, f32)>,
    spheres: Placed<f32>,
    meshes: Vec<PlacedMesh>,
}

impl Body {
    /// The body with these shapes; those without a colour get `default`. Surfaces lie `inset_m`
    /// deeper than they are: two bodies at one place must not flicker through each other.
    pub(super) fn new(shapes: &[Shape], default: Color, inset_m: f64) -> Self {
        let mut body = Self {
            boxes: Placed::new(),
            cylinders: Placed::new(),
            spheres: Placed::new(),
            meshes: Vec::new(),
        };
        for shape in shapes {
            let color = shape.color_rgba.map_or(default, color);
            let place = &shape.link_from_shape;
            let inner = |half: f64| single(half - inset_m.min(half * THINNEST));
            match &shape.geometry {
                Geometry::Box { size_m } => {
                    body.boxes.push(place, color, (size_m / 2.0).map(inner).into());
                }
                Geometry::Cylinder { radius_m, length_m } => {
                    let length = 2.0 * inner(length_m / 2.0);
                    body.cylinders.push(place, color, (inner(*radius_m), length));
                }
                Geometry::Sphere { radius_m } => body.spheres.push(place, color, inner(*radius_m)),
                Geometry::Mesh(mesh) if mesh.triangles.is_empty() => {}
                Geometry::Mesh(mesh) => {
                    body.meshes.push(PlacedMesh { archetype: triangles(mesh, place, inset_m), color });
                }
            }
        }
        body
    }

    /// The shapes, without colours: each path with what stands there.
    pub(super) fn shapes(&self, path: &EntityPath) -> Vec<(EntityPath, Vec<SerializedComponentBatch>)> {
        let mut own = Vec::new();
        if !self.boxes.centers.is_empty() {
            let boxes = Boxes3D::from_centers_and_half_sizes(&self.boxes.centers, &self.boxes.measures)
                .with_quaternions(self.boxes.quaternions.iter().copied())
                .with_fill_mode(FillMode::Solid);
            own.extend(boxes.as_serialized_batches());
        }
        if !self.cylinders.centers.is_empty() {
            let (radii, lengths): (Vec<_>, Vec<_>) = self.cylinders.measures.iter().copied().unzip();
            let cylinders = Cylinders3D::from_lengths_and_radii(lengths, radii)
                .with_centers(&self.cylinders.centers)
                .with_quaternions(self.cylinders.quaternions.iter().copied())
                .with_fill_mode(FillMode::Solid);
            own.extend(cylinders.as_serialized_batches());
        }
        if !self.spheres.centers.is_empty() {
            let spheres = Ellipsoids3D::from_centers_and_radii(
                &self.spheres.centers,
                self.spheres.measures.iter().copied(),
            )
            .with_fill_mode(FillMode::Solid);
            own.extend(spheres.as_serialized_batches());
        }
        let meshes = self.meshes.iter().enumerate();
        let meshes =
            meshes.map(|(index, mesh)| (mesh_path(path, index), mesh.archetype.as_serialized_batches()));
        std::iter::once((path.clone(), own)).chain(meshes).filter(|(_, parts)| !parts.is_empty()).collect()
    }

    /// The colours: each path with the paint that belongs there.
    pub(super) fn colors(
        &self,
        path: &EntityPath,
        paint: Paint,
    ) -> Vec<(EntityPath, Vec<SerializedComponentBatch>)> {
        let painted = |color: &Color| match paint {
            Paint::Own => *color,
            Paint::Plain(color) => color,
        };
        let all = |colors: &[Color]| colors.iter().map(painted).collect::<Vec<_>>();
        let mut own = Vec::new();
        if !self.boxes.colors.is_empty() {
            own.extend(Boxes3D::update_fields().with_colors(all(&self.boxes.colors)).as_serialized_batches());
        }
        if !self.cylinders.colors.is_empty() {
            let cylinders = Cylinders3D::update_fields().with_colors(all(&self.cylinders.colors));
            own.extend(cylinders.as_serialized_batches());
        }
        if !self.spheres.colors.is_empty() {
            let spheres = Ellipsoids3D::update_fields().with_colors(all(&self.spheres.colors));
            own.extend(spheres.as_serialized_batches());
        }
        let meshes = self.meshes.iter().enumerate().map(|(index, mesh)| {
            let factor = AlbedoFactor(painted(&mesh.color).0);
            let mesh = Mesh3D::update_fields().with_albedo_factor(factor);
            (mesh_path(path, index), mesh.as_serialized_batches())
        });
        std::iter::once((path.clone(), own)).chain(meshes).filter(|(_, parts)| !parts.is_empty()).collect()
    }
}

fn mesh_path(body: &EntityPath, index: usize) -> EntityPath {
    body / EntityPathPart::new(format!("mesh_{index}"))
}

/// The mesh in the body's frame, smoothly shaded: each vertex has the mean normal of the triangles
/// that share it, weighted by their areas.
fn triangles(mesh: &Mesh, body_from_mesh: &Isometry3<f64>, inset_m: f64) -> Mesh3D {
    let vertices: Vec<_> = mesh.vertices_m.iter().map(|vertex| body_from_mesh * vertex).collect();
    let mut normals = vec![Vector3::zeros(); vertices.len()];
    for &corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
        let twice_area = (b - a).cross(&(c - a));
        for corner in corners {
            normals[corner as usize] += twice_area;
        }
    }
    for normal in &mut normals {
        *normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
    }
    let surface = vertices.iter().zip(&normals).map(|(vertex, normal)| vertex.coords - normal * inset_m);
    Mesh3D::new(surface.map(|vertex| vector(&vertex)))
        .with_vertex_normals(normals.iter().map(vector))
        .with_triangle_indices(mesh.triangles.iter().map(|&corners| TriangleIndices(corners.into())))
}

/// rerun keeps places in single precision: a tenth of a micrometre at one metre. Errors are never
/// read back from them.
pub(super) fn vector(vector: &Vector3<f64>) -> [f32; 3] {
    [single(vector.x), single(vector.y), single(vector.z)]
}

/// The turn of a pose in single precision.
pub(super) fn quaternion(pose: &Isometry3<f64>) -> Quaternion {
    Quaternion::from_xyzw(pose.rotation.coords.map(single).into())
}

#[expect(clippy::cast_possible_truncation, reason = "rerun draws in single precision")]
pub(super) fn single(value: f64) -> f32 {
    value as f32
}

/// A colour of a description, whose channels go from 0 to 1.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0 to 255; the cast of floats saturates"
)]
fn color(rgba: [f32; 4]) -> Color {
    let [r, g, b, a] = rgba.map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8);
    Color::from_unmultiplied_rgba(r, g, b, a)
}
