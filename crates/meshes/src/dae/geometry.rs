//! `<geometry>`: sources and primitives to vertices and triangles, in the units of the file.

use std::collections::BTreeMap;

use nalgebra::Point3;
use roxmltree::Node;

use super::node::{Ids, child, children, fault, numbers};
use crate::mesh_file::{MeshError, fan};

/// One geometry in its own frame.
#[derive(Debug, Default)]
pub(super) struct GeometryPart {
    pub(super) vertices: Vec<Point3<f64>>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl GeometryPart {
    /// Only the vertices that a triangle uses: the others would still count in a convex hull.
    fn without_unused(self) -> Self {
        let mut new_index = vec![None; self.vertices.len()];
        let mut vertices = Vec::new();
        let mut renumber = |corner: u32| {
            *new_index[corner as usize].get_or_insert_with(|| {
                vertices.push(self.vertices[corner as usize]);
                // The new index is at most the old one, which is a u32.
                u32::try_from(vertices.len() - 1).unwrap_or(u32::MAX)
            })
        };
        let triangles = self.triangles.iter().map(|corners| corners.map(&mut renumber)).collect();
        Self { vertices, triangles }
    }
}

/// The range of a list of positions among the vertices of a part.
#[derive(Clone, Copy)]
struct Positions {
    first: usize,
    count: usize,
}

/// Reads a geometry, whose sources `ids` finds.
pub(super) fn read_geometry<'a, 'i>(
    geometry: Node<'a, 'i>,
    ids: &Ids<'a, 'i>,
) -> Result<GeometryPart, MeshError> {
    let mut part = GeometryPart::default();
    // Splines and convex hulls of other geometries hold no triangles of their own.
    let Some(mesh) = child(geometry, "mesh") else { return Ok(part) };
    let mut known: BTreeMap<&str, Positions> = BTreeMap::new();
    for primitive in mesh.children().filter(Node::is_element) {
        let name = primitive.tag_name().name();
        if !["triangles", "polylist", "polygons", "tristrips", "trifans"].contains(&name) {
            continue;
        }
        let vertex = input(primitive, "VERTEX")?;
        let (id, vertices) = ids.target(vertex, "source", "vertices")?;
        // Primitives of one geometry mostly share their vertices, which are read once.
        let positions = if let Some(positions) = known.get(id) {
            *positions
        } else {
            let found = self::positions(vertices, ids)?;
            let positions = Positions { first: part.vertices.len(), count: found.len() };
            part.vertices.extend(found);
            known.insert(id, positions);
            positions
        };
        add_triangles(&mut part, primitive, &Corners::new(primitive, vertex, positions)?)?;
    }
    Ok(part.without_unused())
}

fn positions<'a, 'i>(vertices: Node<'a, 'i>, ids: &Ids<'a, 'i>) -> Result<Vec<Point3<f64>>, MeshError> {
    let (_, source) = ids.target(input(vertices, "POSITION")?, "source", "source")?;
    let accessor = child(source, "technique_common").and_then(|common| child(common, "accessor"));
    let Some(accessor) = accessor else { return Err(fault(source, "<source> has no <accessor>")) };
    let (_, array) = ids.target(accessor, "source", "float_array")?;
    let [count, stride, offset] = [
        number(accessor, "count", None)?,
        number(accessor, "stride", Some(1))?,
        number(accessor, "offset", Some(0))?,
    ];
    if stride < 3 {
        return Err(fault(accessor, format!("positions have {stride} numbers each, 3 are needed")));
    }
    let values: Vec<f64> = numbers(array)?;
    let needed = count.checked_mul(stride).and_then(|needed| needed.checked_add(offset));
    if needed.is_none_or(|needed| needed > values.len()) {
        let what = format!(
            "<accessor> declares {count} positions of {stride} numbers, but the array holds {}",
            values.len()
        );
        return Err(fault(array, what));
    }
    Ok(values[offset..].chunks_exact(stride).take(count).map(|p| Point3::new(p[0], p[1], p[2])).collect())
}

/// The input with this semantic.
fn input<'a, 'i>(parent: Node<'a, 'i>, semantic: &str) -> Result<Node<'a, 'i>, MeshError> {
    let found = children(parent, "input").find(|input| input.attribute("semantic") == Some(semantic));
    found.ok_or_else(|| fault(parent, format!("<{}> has no input {semantic}", parent.tag_name().name())))
}

/// An attribute that counts something.
fn number(node: Node<'_, '_>, key: &str, default: Option<usize>) -> Result<usize, MeshError> {
    let text = node.attribute(key);
    let value = text.map_or(default, |text| text.trim().parse().ok());
    value.ok_or_else(|| {
        let found = text.map_or("missing".to_owned(), |text| format!("\"{text}\""));
        fault(node, format!("<{}> {key} is {found}, a number is needed", node.tag_name().name()))
    })
}

/// How the vertex indices lie among the indices of a primitive.
struct Corners {
    positions: Positions,
    /// Indices for each corner: position, normal, texture, ...
    stride: usize,
    /// Which of them is the position's.
    offset: usize,
}

impl Corners {
    fn new(primitive: Node<'_, '_>, vertex: Node<'_, '_>, positions: Positions) -> Result<Self, MeshError> {
        let mut last = 0;
        for input in children(primitive, "input") {
            last = last.max(number(input, "offset", Some(0))?);
        }
        // Each corner has one index for every offset, whatever it is for: texture and normals are skipped by the
        // stride.
        Ok(Self { positions, stride: last.saturating_add(1), offset: number(vertex, "offset", Some(0))? })
    }

    /// The vertices of the corners that a `<p>` lists.
    fn read(&self, p: Node<'_, '_>) -> Result<Vec<u32>, MeshError> {
        let indices: Vec<usize> = numbers(p)?;
        if !indices.len().is_multiple_of(self.stride) {
            let what =
                format!("<p> holds {} indices, which is not a multiple of {}", indices.len(), self.stride);
            return Err(fault(p, what));
        }
        let Positions { first, count } = self.positions;
        let vertex = |corner: &[usize]| {
            let index = corner[self.offset];
            let vertex = (index < count).then(|| u32::try_from(first + index).ok()).flatten();
            vertex.ok_or_else(|| {
                fault(p, format!("vertex index {index} is out of range: there are {count} vertices"))
            })
        };
        indices.chunks_exact(self.stride).map(vertex).collect()
    }
}

fn add_triangles(
    part: &mut GeometryPart,
    primitive: Node<'_, '_>,
    corners: &Corners,
) -> Result<(), MeshError> {
    let name = primitive.tag_name().name();
    let mut sizes = match child(primitive, "vcount") {
        Some(vcount) if name == "polylist" => numbers::<usize>(vcount)?.into_iter(),
        _ => Vec::new().into_iter(),
    };
    for p in children(primitive, "p") {
        let list = corners.read(p)?;
        match name {
            "triangles" => {
                if !list.len().is_multiple_of(3) {
                    return Err(fault(
                        p,
                        format!("{} corners are not a whole number of triangles", list.len()),
                    ));
                }
                part.triangles.extend(list.chunks_exact(3).map(|c| [c[0], c[1], c[2]]));
            }
            "polylist" => {
                let mut rest = &list[..];
                for size in sizes.by_ref() {
                    let polygon = rest.split_at_checked(size);
                    let (polygon, after) = polygon.ok_or_else(|| {
                        fault(p, format!("<vcount> counts more corners than the {} in <p>", list.len()))
                    })?;
                    part.triangles.extend(fan(polygon));
                    rest = after;
                }
            }
            "tristrips" => {
                // Each triangle of a strip shares an edge with the one before, so every second one runs the other way
                // round.
                let turned = |(at, c): (usize, &[u32])| {
                    if at % 2 == 0 { [c[0], c[1], c[2]] } else { [c[0], c[2], c[1]] }
                };
                part.triangles.extend(list.windows(3).enumerate().map(turned));
            }
            // Fans, and polygons, which are assumed to be convex.
            _ => part.triangles.extend(fan(&list)),
        }
    }
    Ok(())
}
