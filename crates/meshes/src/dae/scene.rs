//! The scene of a COLLADA document: its nodes with their transforms, and the geometries that they place.

use std::collections::BTreeMap;

use congruent_input::{units, xml};
use nalgebra::{Matrix4, Point3, Rotation3, Unit, Vector3};
use roxmltree::Node;

use super::{
    geometry::{GeometryPart, read_geometry},
    node::{Ids, child, children, fault, format_fault, numbers_of},
};
use crate::mesh_file::{MeshError, MeshFile};

/// Most nodes of a scene. Nodes may instance nodes, so a small file could otherwise expand to 2^60 of them.
const MOST_NODES: usize = 100_000;
/// Most triangles of a scene, for the same reason.
const MOST_TRIANGLES: usize = 20_000_000;

pub(crate) fn parse(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let text = std::str::from_utf8(bytes).map_err(|_| format_fault("COLLADA text is not UTF-8"))?;
    let text = text.trim_start_matches('\u{feff}');
    let document = xml::parse(text).map_err(|fault| format_fault(fault.message))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(fault(root, format!("the root element is <{}>, not <COLLADA>", root.tag_name().name())));
    }
    let mut reader =
        SceneReader { ids: Ids::new(&document), parts: BTreeMap::new(), mesh: MeshFile::default() };
    let metres = Matrix4::new_scaling(unit_m(root)?);
    reader.scene(root, metres)?;
    Ok(reader.mesh)
}

fn unit_m(root: Node<'_, '_>) -> Result<f64, MeshError> {
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let Some((unit, text)) = unit.and_then(|unit| Some((unit, unit.attribute("meter")?))) else {
        return Ok(1.0);
    };
    let metres = text.trim().parse::<f64>().ok().filter(|metres| metres.is_finite() && *metres > 0.0);
    metres.ok_or_else(|| fault(unit, format!("<unit meter=\"{text}\"> is not a positive number")))
}

struct SceneReader<'a, 'i> {
    ids: Ids<'a, 'i>,
    /// Geometries that have been read, by id.
    parts: BTreeMap<&'a str, GeometryPart>,
    mesh: MeshFile,
}

impl<'a, 'i> SceneReader<'a, 'i> {
    fn scene(&mut self, root: Node<'a, 'i>, metres: Matrix4<f64>) -> Result<(), MeshError> {
        let instance = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
        let scene = match instance {
            Some(instance) => Some(self.ids.target(instance, "url", "visual_scene")?.1),
            // Without <scene> the first visual scene counts, as viewers do it.
            None => child(root, "library_visual_scenes").and_then(|library| child(library, "visual_scene")),
        };
        let Some(scene) = scene else { return Ok(()) };
        let mut open: Vec<_> = children(scene, "node").map(|node| (node, metres)).collect();
        let mut nodes = 0;
        // A list instead of recursion: files may nest arbitrarily deep. `MOST_NODES` also ends instances that contain
        // themselves.
        while let Some((node, scene_from_parent)) = open.pop() {
            nodes += 1;
            if nodes > MOST_NODES {
                return Err(fault(node, format!("the scene has more than {MOST_NODES} nodes")));
            }
            let scene_from_node = scene_from_parent * transform(node)?;
            for instance in children(node, "instance_geometry") {
                self.add_geometry(instance, &scene_from_node)?;
            }
            for instance in children(node, "instance_node") {
                open.push((self.ids.target(instance, "url", "node")?.1, scene_from_node));
            }
            open.extend(children(node, "node").map(|node| (node, scene_from_node)));
        }
        Ok(())
    }

    fn add_geometry(
        &mut self,
        instance: Node<'a, 'i>,
        scene_from_node: &Matrix4<f64>,
    ) -> Result<(), MeshError> {
        let (id, node) = self.ids.target(instance, "url", "geometry")?;
        if !self.parts.contains_key(id) {
            let part = read_geometry(node, &self.ids)?;
            self.parts.insert(id, part);
        }
        let part = &self.parts[id];
        if self.mesh.triangles.len() + part.triangles.len() > MOST_TRIANGLES {
            return Err(fault(instance, format!("the scene has more than {MOST_TRIANGLES} triangles")));
        }
        // Fewer triangles than that have fewer vertices than an index can count, or are unused.
        let first = u32::try_from(self.mesh.vertices_m.len()).unwrap_or(u32::MAX);
        let place = |vertex: &Point3<f64>| scene_from_node.transform_point(vertex);
        self.mesh.vertices_m.extend(part.vertices.iter().map(place));
        let is_mirrored = scene_from_node.determinant() < 0.0;
        self.mesh.triangles.extend(part.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| first.saturating_add(corner));
            if is_mirrored { [a, c, b] } else { [a, b, c] }
        }));
        Ok(())
    }
}

/// The transforms of a node in the order in which they are written, outermost first.
fn transform(node: Node<'_, '_>) -> Result<Matrix4<f64>, MeshError> {
    let mut parent_from_node = Matrix4::identity();
    for step in node.children().filter(Node::is_element) {
        // In the order of the file, each step in the frame of the ones before (COLLADA 1.4, <node>).
        parent_from_node *= match step.tag_name().name() {
            "matrix" => Matrix4::from_row_slice(&numbers_of::<16>(step)?),
            "translate" => Matrix4::new_translation(&Vector3::from(numbers_of::<3>(step)?)),
            "scale" => Matrix4::new_nonuniform_scaling(&Vector3::from(numbers_of::<3>(step)?)),
            "rotate" => {
                let [x, y, z, degrees] = numbers_of::<4>(step)?;
                let axis = Unit::try_new(Vector3::new(x, y, z), 0.0)
                    .ok_or_else(|| fault(step, "<rotate> about a zero axis"))?;
                Rotation3::from_axis_angle(&axis, units::Unit::Angle.convert(degrees)).to_homogeneous()
            }
            "skew" | "lookat" => {
                return Err(fault(step, format!("<{}> is not supported", step.tag_name().name())));
            }
            _ => continue,
        };
    }
    Ok(parent_from_node)
}
