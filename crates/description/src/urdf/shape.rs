//! `<visual>` and `<collision>`: shapes, their colours and their meshes.

use std::collections::BTreeMap;

use congruent_input::{Capability, Diagnostic, Diagnostics, units::LARGEST_PLAUSIBLE_M};
use congruent_meshes::{FindMesh, Mesh};
use congruent_robot::{Geometry, Shape};
use nalgebra::{Isometry3, Vector3};
use roxmltree::Node;

use super::{
    node::{element, label, tag},
    pose,
};
use crate::codes;

/// Colours of the materials that the document defines at its top, by name.
pub(super) fn named_colors(urdf: &urdf_rs::Robot) -> BTreeMap<&str, [f32; 4]> {
    urdf.materials
        .iter()
        .filter_map(|material| Some((material.name.as_str(), own_color(material)?)))
        .collect()
}

fn own_color(material: &urdf_rs::Material) -> Option<[f32; 4]> {
    #[expect(clippy::cast_possible_truncation, reason = "a colour for the eye")]
    material.color.as_ref().map(|color| color.rgba.0.map(|channel| channel.clamp(0.0, 1.0) as f32))
}

/// A shape with its pose in the frame of its element.
type PlacedGeometry = (Isometry3<f64>, Geometry);

/// Reads shapes, with what is defined outside their own element: named colours and meshes.
pub(super) struct ShapeReader<'a, 'm> {
    pub(super) colors: BTreeMap<&'a str, [f32; 4]>,
    pub(super) find_mesh: &'a mut FindMesh<'m>,
    pub(super) diagnostics: &'a mut Diagnostics,
}

impl ShapeReader<'_, '_> {
    /// The shapes of a visual, of which only a capsule has several; none if something is wrong with it.
    pub(super) fn visual(&mut self, visual: &urdf_rs::Visual, node: Node<'_, '_>) -> Vec<Shape> {
        let color = |material: &urdf_rs::Material| {
            own_color(material).or_else(|| self.colors.get(material.name.as_str()).copied())
        };
        let color_rgba = visual.material.as_ref().and_then(color);
        let shapes = self.shapes(&visual.origin, &visual.geometry, node, None);
        shapes.into_iter().map(|shape| Shape { color_rgba, ..shape }).collect()
    }

    /// The shapes of a collision, of which only a capsule has several; none if something is wrong with it.
    pub(super) fn collision(&mut self, collision: &urdf_rs::Collision, node: Node<'_, '_>) -> Vec<Shape> {
        self.shapes(&collision.origin, &collision.geometry, node, Some(Capability::Clearance))
    }

    fn shapes(
        &mut self,
        origin: &urdf_rs::Pose,
        geometry: &urdf_rs::Geometry,
        node: Node<'_, '_>,
        needed_by: Option<Capability>,
    ) -> Vec<Shape> {
        let owner = node.parent_element().unwrap_or(node);
        let link_from_shape =
            pose::read(origin, pose::OriginPlace { parent: node, owner, needed_by }, self.diagnostics);
        let place =
            element(node, "geometry").and_then(|geometry| geometry.first_element_child()).unwrap_or(node);
        let parts = match self.parts(geometry) {
            Ok((parts, warnings)) => {
                self.diagnostics.extend(warnings.into_iter().map(|warning| placed(warning, owner, place)));
                parts
            }
            Err(fault) => {
                self.diagnostics.push(placed(fault, owner, place).needed_by(needed_by));
                return Vec::new();
            }
        };
        let shape =
            |(at, geometry)| Shape { link_from_shape: link_from_shape * at, geometry, color_rgba: None };
        parts.into_iter().map(shape).collect()
    }

    fn parts(
        &mut self,
        geometry: &urdf_rs::Geometry,
    ) -> Result<(Vec<PlacedGeometry>, Vec<Diagnostic>), Diagnostic> {
        use urdf_rs::Geometry as Written;
        let (geometry, smallest_m) = match *geometry {
            Written::Box { size } => {
                let smallest =
                    check_sizes("box", &[("size", size[0]), ("size", size[1]), ("size", size[2])])?;
                (Geometry::Box { size_m: size.0.into() }, smallest)
            }
            Written::Cylinder { radius, length } => {
                let smallest = check_sizes("cylinder", &[("radius", radius), ("length", length)])?;
                (Geometry::Cylinder { radius_m: radius, length_m: length }, smallest)
            }
            Written::Sphere { radius } => {
                let smallest = check_sizes("sphere", &[("radius", radius)])?;
                (Geometry::Sphere { radius_m: radius }, smallest)
            }
            Written::Capsule { radius, length } => {
                let smallest = check_sizes("capsule", &[("radius", radius), ("length", length)])?;
                return Ok((
                    Geometry::capsule(radius, length),
                    too_large("shape", smallest).into_iter().collect(),
                ));
            }
            Written::Mesh { ref filename, scale } => {
                let scale = scale.map_or(Vector3::repeat(1.0), |scale| scale.0.into());
                let (mesh, warnings) = self.mesh(filename, scale)?;
                return Ok((vec![(Isometry3::identity(), mesh)], warnings));
            }
        };
        // The smallest side, so that a wide floor raises no warning.
        let warnings = too_large("shape", smallest_m).into_iter().collect();
        Ok((vec![(Isometry3::identity(), geometry)], warnings))
    }

    fn mesh(&mut self, uri: &str, scale: Vector3<f64>) -> Result<(Geometry, Vec<Diagnostic>), Diagnostic> {
        if scale.iter().any(|factor| *factor == 0.0) {
            let [x, y, z] = scale.into();
            let message = format!("mesh \"{uri}\": scale \"{x} {y} {z}\" flattens it to zero volume");
            return Err(Diagnostic::error(codes::urdf::SCALE, message));
        }
        let found = (self.find_mesh)(uri, scale)?;
        let mut warnings = found.warnings;
        warnings.extend(too_large(&format!("mesh \"{uri}\""), extent(&found.mesh)));
        Ok((Geometry::Mesh(found.mesh), warnings))
    }
}

fn placed(diagnostic: Diagnostic, owner: Node<'_, '_>, place: Node<'_, '_>) -> Diagnostic {
    let message = format!("{}: {}", label(owner), diagnostic.message);
    let placed = Diagnostic { message, ..diagnostic }.at(tag(place));
    if placed.code == codes::urdf::MILLIMETRES {
        placed.one_of("shapes are more than 10 m large", label(owner))
    } else {
        placed
    }
}

/// The smallest of the sizes, all of which must be positive.
fn check_sizes(shape: &str, sizes: &[(&str, f64)]) -> Result<f64, Diagnostic> {
    match sizes.iter().find(|(_, size)| *size <= 0.0) {
        Some((key, size)) => {
            let message = format!("{shape} {key} {size} must be positive");
            Err(Diagnostic::error(codes::urdf::GEOMETRY, message))
        }
        None => Ok(sizes.iter().fold(f64::INFINITY, |least, (_, size)| least.min(*size))),
    }
}

fn too_large(what: &str, size_m: f64) -> Option<Diagnostic> {
    (size_m > LARGEST_PLAUSIBLE_M).then(|| {
        Diagnostic::warning(codes::urdf::MILLIMETRES, format!("{what} is {size_m:.1} m large"))
            .with_help("millimetres instead of metres? a mesh takes scale=\"0.001 0.001 0.001\"")
    })
}

/// Longest edge of the box around a mesh.
fn extent(mesh: &Mesh) -> f64 {
    let Some(first) = mesh.vertices_m.first() else { return 0.0 };
    let corners = (first.coords, first.coords);
    let (least, most) = mesh
        .vertices_m
        .iter()
        .fold(corners, |(least, most), vertex| (least.inf(&vertex.coords), most.sup(&vertex.coords)));
    (most - least).max()
}
