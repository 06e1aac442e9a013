//! COLLADA: the scene as one list of triangles.
//!
//! Of the asset's settings `<unit meter>` is applied and `<up_axis>` is not: ROS tools ignore it,
//! and robot meshes are modelled in the axes of their link whatever it says. Nodes carry their
//! transforms and instances; materials, skins and animations mean nothing to a rigid link.

mod geometry;

use std::collections::BTreeMap;

use nalgebra::{Matrix4, Point3, Rotation3, Unit, Vector3};
use roxmltree::{Document, Node};

use self::geometry::Part;
use super::{MeshError, MeshFile};
use crate::{units, xml};

/// Nodes may instance nodes: without a bound a small file could ask for 2^60 of them.
const MOST_NODES: usize = 100_000;
/// The same for their triangles.
const MOST_TRIANGLES: usize = 20_000_000;

pub(super) fn parse(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let text = std::str::from_utf8(bytes).map_err(|_| format_fault("COLLADA text is not UTF-8"))?;
    let text = text.trim_start_matches('\u{feff}');
    let document = xml::parse(text).map_err(|fault| format_fault(fault.message))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(fault(root, format!("the root element is <{}>, not <COLLADA>", root.tag_name().name())));
    }
    let mut reader = Reader::new(&document);
    let metres = Matrix4::new_scaling(unit_m(root)?);
    reader.scene(root, metres)?;
    Ok(reader.mesh)
}

fn format_fault(what: impl Into<String>) -> MeshError {
    MeshError::Format { what: what.into() }
}

/// A fault at an element.
fn fault(node: Node<'_, '_>, what: impl Into<String>) -> MeshError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    MeshError::Line { line, what: what.into() }
}

fn child<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    children(parent, name).next()
}

fn children<'a, 'i>(parent: Node<'a, 'i>, name: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    parent.children().filter(move |node| node.tag_name().name() == name)
}

/// The figures that an element holds as text.
fn figures<T: std::str::FromStr>(node: Node<'_, '_>) -> Result<Vec<T>, MeshError> {
    let parse = |token: &str| {
        token
            .parse()
            .map_err(|_| fault(node, format!("<{}>: \"{token}\" is not a number", node.tag_name().name())))
    };
    node.text().unwrap_or_default().split_ascii_whitespace().map(parse).collect()
}

fn figures_of<const N: usize>(node: Node<'_, '_>) -> Result<[f64; N], MeshError> {
    let found: Vec<f64> = figures(node)?;
    let count = found.len();
    found
        .try_into()
        .map_err(|_| fault(node, format!("<{}> needs {N} numbers, found {count}", node.tag_name().name())))
}

fn unit_m(root: Node<'_, '_>) -> Result<f64, MeshError> {
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let Some((unit, text)) = unit.and_then(|unit| Some((unit, unit.attribute("meter")?))) else {
        return Ok(1.0);
    };
    let metres = text.trim().parse::<f64>().ok().filter(|metres| metres.is_finite() && *metres > 0.0);
    metres.ok_or_else(|| fault(unit, format!("<unit meter=\"{text}\"> is not a positive number")))
}

struct Reader<'a, 'i> {
    by_id: BTreeMap<&'a str, Node<'a, 'i>>,
    /// Geometries that have been read, by id.
    parts: BTreeMap<&'a str, Part>,
    mesh: MeshFile,
}

impl<'a, 'i> Reader<'a, 'i> {
    fn new(document: &'a Document<'i>) -> Self {
        let by_id = document.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
        Self { by_id, parts: BTreeMap::new(), mesh: MeshFile::default() }
    }

    /// What the `key` of a node points to: `#id`, of an element called `name`.
    fn target(
        &self,
        node: Node<'a, 'i>,
        key: &str,
        name: &str,
    ) -> Result<(&'a str, Node<'a, 'i>), MeshError> {
        let url = node.attribute(key).unwrap_or_default();
        let id = url.strip_prefix('#').unwrap_or(url);
        match self.by_id.get_key_value(id) {
            Some((id, target)) if target.tag_name().name() == name => Ok((id, *target)),
            _ => Err(fault(node, format!("<{name}> \"{url}\" not found"))),
        }
    }

    fn scene(&mut self, root: Node<'a, 'i>, metres: Matrix4<f64>) -> Result<(), MeshError> {
        let instance = child(root, "scene").and_then(|scene| child(scene, "instance_visual_scene"));
        let scene = match instance {
            Some(instance) => Some(self.target(instance, "url", "visual_scene")?.1),
            None => child(root, "library_visual_scenes").and_then(|library| child(library, "visual_scene")),
        };
        let Some(scene) = scene else { return Ok(()) };
        let mut open: Vec<_> = children(scene, "node").map(|node| (node, metres)).collect();
        let mut nodes = 0;
        while let Some((node, scene_from_parent)) = open.pop() {
            nodes += 1;
            if nodes > MOST_NODES {
                return Err(fault(node, format!("more than {MOST_NODES} nodes")));
            }
            let scene_from_node = scene_from_parent * transform(node)?;
            for instance in children(node, "instance_geometry") {
                self.add_geometry(instance, &scene_from_node)?;
            }
            for instance in children(node, "instance_node") {
                open.push((self.target(instance, "url", "node")?.1, scene_from_node));
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
        let (id, node) = self.target(instance, "url", "geometry")?;
        if !self.parts.contains_key(id) {
            let part = self.read_geometry(node)?;
            self.parts.insert(id, part);
        }
        let part = &self.parts[id];
        if self.mesh.triangles.len() + part.triangles.len() > MOST_TRIANGLES {
            return Err(fault(instance, format!("more than {MOST_TRIANGLES} triangles")));
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
        parent_from_node *= match step.tag_name().name() {
            "matrix" => Matrix4::from_row_slice(&figures_of::<16>(step)?),
            "translate" => Matrix4::new_translation(&Vector3::from(figures_of::<3>(step)?)),
            "scale" => Matrix4::new_nonuniform_scaling(&Vector3::from(figures_of::<3>(step)?)),
            "rotate" => {
                let [x, y, z, degrees] = figures_of::<4>(step)?;
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

#[cfg(test)]
mod tests;
