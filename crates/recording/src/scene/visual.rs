//! The shapes of one link, obstacle or zone in rerun's types: boxes, cylinders and ellipsoids at the body's own
//! path, each mesh at a path below it.

use congruent_description::{Geometry, Mesh, Shape};
use nalgebra::{Isometry3, Vector3};
use re_log_types::{EntityPath, EntityPathPart};
use re_sdk_types::{
    AsComponents, SerializedComponentBatch,
    archetypes::{Boxes3D, Cylinders3D, Ellipsoids3D, Mesh3D},
    components::{AlbedoFactor, Color, FillMode, TriangleIndices},
    datatypes::Quaternion,
};

use crate::rrd::convert::{quaternion, single, vector};

/// The largest inset of a surface, as a fraction of half the shape's thickness.
const MAX_INSET_FRACTION: f64 = 0.1;

/// Shapes of one kind: their poses in the body, colours and sizes.
#[derive(Debug)]
struct ShapeColumns<S> {
    centers: Vec<[f32; 3]>,
    quaternions: Vec<Quaternion>,
    colors: Vec<Color>,
    sizes: Vec<S>,
}

impl<S> ShapeColumns<S> {
    fn new() -> Self {
        Self { centers: Vec::new(), quaternions: Vec::new(), colors: Vec::new(), sizes: Vec::new() }
    }

    fn push(&mut self, body_from_shape: &Isometry3<f64>, color: Color, size: S) {
        self.centers.push(vector(&body_from_shape.translation.vector));
        self.quaternions.push(quaternion(body_from_shape));
        self.colors.push(color);
        self.sizes.push(size);
    }
}

/// A mesh in the body's frame, with its colour.
#[derive(Debug)]
struct ColoredMesh {
    archetype: Mesh3D,
    color: Color,
}

/// The colours of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coloring {
    /// Each shape in the colour of its description.
    AsDescribed,
    /// All shapes in one colour.
    Uniform(Color),
}

/// What is drawn for a link, an obstacle or a zone.
#[derive(Debug)]
pub(crate) struct VisualBody {
    boxes: ShapeColumns<[f32; 3]>,
    cylinders: ShapeColumns<(f32, f32)>,
    /// Spheres among them.
    ellipsoids: ShapeColumns<[f32; 3]>,
    meshes: Vec<ColoredMesh>,
}

impl VisualBody {
    /// The body with these shapes; a shape without a colour gets `default`. Surfaces are moved inwards by
    /// `inset_m`: two bodies at the same pose must not flicker through each other.
    pub(crate) fn new(shapes: &[Shape], default: Color, inset_m: f64) -> Self {
        let mut body = Self {
            boxes: ShapeColumns::new(),
            cylinders: ShapeColumns::new(),
            ellipsoids: ShapeColumns::new(),
            meshes: Vec::new(),
        };
        for shape in shapes {
            let color = shape.color_rgba.map_or(default, color);
            let body_from_shape = &shape.link_from_shape;
            // At most a tenth of it, so that a thin plate keeps some thickness.
            let inner = |half: f64| single(half - inset_m.min(half * MAX_INSET_FRACTION));
            match &shape.geometry {
                Geometry::Box { size_m } => {
                    body.boxes.push(body_from_shape, color, (size_m / 2.0).map(inner).into());
                }
                Geometry::Cylinder { radius_m, length_m } => {
                    let length = 2.0 * inner(length_m / 2.0);
                    body.cylinders.push(body_from_shape, color, (inner(*radius_m), length));
                }
                Geometry::Sphere { radius_m } => {
                    body.ellipsoids.push(body_from_shape, color, [inner(*radius_m); 3]);
                }
                Geometry::Ellipsoid { semi_axes_m } => {
                    body.ellipsoids.push(body_from_shape, color, semi_axes_m.map(inner).into());
                }
                Geometry::Mesh(mesh) if mesh.triangles.is_empty() => {}
                Geometry::Mesh(mesh) => {
                    body.meshes
                        .push(ColoredMesh { archetype: triangles(mesh, body_from_shape, inset_m), color });
                }
            }
        }
        body
    }

    /// The shapes without colours: the components of each path.
    pub(crate) fn shapes(&self, path: &EntityPath) -> Vec<(EntityPath, Vec<SerializedComponentBatch>)> {
        let mut own = Vec::new();
        if !self.boxes.centers.is_empty() {
            let boxes = Boxes3D::from_centers_and_half_sizes(&self.boxes.centers, &self.boxes.sizes)
                .with_quaternions(self.boxes.quaternions.iter().copied())
                .with_fill_mode(FillMode::Solid);
            own.extend(boxes.as_serialized_batches());
        }
        if !self.cylinders.centers.is_empty() {
            let (radii, lengths): (Vec<_>, Vec<_>) = self.cylinders.sizes.iter().copied().unzip();
            let cylinders = Cylinders3D::from_lengths_and_radii(lengths, radii)
                .with_centers(&self.cylinders.centers)
                .with_quaternions(self.cylinders.quaternions.iter().copied())
                .with_fill_mode(FillMode::Solid);
            own.extend(cylinders.as_serialized_batches());
        }
        if !self.ellipsoids.centers.is_empty() {
            let ellipsoids =
                Ellipsoids3D::from_centers_and_half_sizes(&self.ellipsoids.centers, &self.ellipsoids.sizes)
                    .with_quaternions(self.ellipsoids.quaternions.iter().copied())
                    .with_fill_mode(FillMode::Solid);
            own.extend(ellipsoids.as_serialized_batches());
        }
        let meshes = self.meshes.iter().enumerate();
        let meshes =
            meshes.map(|(index, mesh)| (mesh_path(path, index), mesh.archetype.as_serialized_batches()));
        std::iter::once((path.clone(), own)).chain(meshes).filter(|(_, parts)| !parts.is_empty()).collect()
    }

    /// The colours: the components of each path, in the order of [`shapes`](Self::shapes).
    pub(crate) fn colors(
        &self,
        path: &EntityPath,
        coloring: Coloring,
    ) -> Vec<(EntityPath, Vec<SerializedComponentBatch>)> {
        let colored = |color: &Color| match coloring {
            Coloring::AsDescribed => *color,
            Coloring::Uniform(color) => color,
        };
        let all = |colors: &[Color]| colors.iter().map(colored).collect::<Vec<_>>();
        let mut own = Vec::new();
        if !self.boxes.colors.is_empty() {
            own.extend(Boxes3D::update_fields().with_colors(all(&self.boxes.colors)).as_serialized_batches());
        }
        if !self.cylinders.colors.is_empty() {
            let cylinders = Cylinders3D::update_fields().with_colors(all(&self.cylinders.colors));
            own.extend(cylinders.as_serialized_batches());
        }
        if !self.ellipsoids.colors.is_empty() {
            let ellipsoids = Ellipsoids3D::update_fields().with_colors(all(&self.ellipsoids.colors));
            own.extend(ellipsoids.as_serialized_batches());
        }
        let meshes = self.meshes.iter().enumerate().map(|(index, mesh)| {
            let factor = AlbedoFactor(colored(&mesh.color).0);
            let mesh = Mesh3D::update_fields().with_albedo_factor(factor);
            (mesh_path(path, index), mesh.as_serialized_batches())
        });
        std::iter::once((path.clone(), own)).chain(meshes).filter(|(_, parts)| !parts.is_empty()).collect()
    }
}

fn mesh_path(body: &EntityPath, index: usize) -> EntityPath {
    body / EntityPathPart::new(format!("mesh_{index}"))
}

/// The mesh in the body's frame with smooth shading: each vertex has the mean normal of the triangles that
/// share it, weighted by their areas.
fn triangles(mesh: &Mesh, body_from_mesh: &Isometry3<f64>, inset_m: f64) -> Mesh3D {
    let vertices: Vec<_> = mesh.vertices_m.iter().map(|vertex| body_from_mesh * vertex).collect();
    let mut normals = vec![Vector3::zeros(); vertices.len()];
    for &corners in &mesh.triangles {
        let [a, b, c] = corners.map(|corner| vertices[corner as usize]);
        // Not normalised: the length weights the normal by the area, so that slivers do not bend the shading.
        let twice_area = (b - a).cross(&(c - a));
        for corner in corners {
            normals[corner as usize] += twice_area;
        }
    }
    for normal in &mut normals {
        // A vertex of no triangle has no normal, and nothing shows which one it gets.
        *normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
    }
    let surface = vertices.iter().zip(&normals).map(|(vertex, normal)| vertex.coords - normal * inset_m);
    Mesh3D::new(surface.map(|vertex| vector(&vertex)))
        .with_vertex_normals(normals.iter().map(vector))
        .with_triangle_indices(mesh.triangles.iter().map(|&corners| TriangleIndices(corners.into())))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ellipsoids_and_spheres_are_drawn_with_their_half_axes_and_turns() {
        let shape = |link_from_shape, geometry| Shape { link_from_shape, geometry, color_rgba: None };
        let turned = Isometry3::rotation(Vector3::x() * std::f64::consts::PI);
        let semi_axes_m = Vector3::new(0.125, 0.25, 0.5);
        let shapes = [
            shape(turned, Geometry::Ellipsoid { semi_axes_m }),
            shape(Isometry3::identity(), Geometry::Sphere { radius_m: 0.25 }),
        ];
        let body = VisualBody::new(&shapes, Color::from_rgb(1, 2, 3), 0.0);
        assert_eq!(body.ellipsoids.sizes, [[0.125, 0.25, 0.5], [0.25; 3]]);
        let drawn = body.shapes(&EntityPath::from("link"));
        let [(_, parts)] = &drawn[..] else { panic!("{drawn:?}") };
        for component in [Ellipsoids3D::descriptor_half_sizes(), Ellipsoids3D::descriptor_quaternions()] {
            let part = parts.iter().find(|part| part.descriptor == component);
            assert_eq!(part.map(|part| part.array.len()), Some(2), "{component:?}");
        }
    }
}
