//! Wavefront OBJ: vertices and faces; all other lines do not change the shape and are skipped.

use std::collections::BTreeMap;

use nalgebra::Point3;

use super::mesh_file::{MeshError, MeshFile};

pub(super) fn parse(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    // Names and comments may be in any encoding; vertices and faces are ASCII.
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = MeshFile { material_libraries: material_libraries(&text), ..MeshFile::default() };
    let (mut vertices, mut places) = (Vec::new(), BTreeMap::new());
    for (line, text) in (1..).zip(text.lines()) {
        let refused = |what: String| MeshError::Line { line, what };
        let mut words = text.split_whitespace();
        match words.next() {
            Some("v") => {
                vertices
                    .push(vertex(words).ok_or_else(|| refused("a vertex needs three numbers".to_owned()))?);
            }
            Some("f") => {
                let corner = |word: &str| corner(word, vertices.len()).map_err(refused);
                let corners = words.map(corner).collect::<Result<Vec<usize>, MeshError>>()?;
                let mut place = |vertex: usize| {
                    *places.entry(vertex).or_insert_with(|| {
                        mesh.vertices_m.push(vertices[vertex]);
                        u32::try_from(mesh.vertices_m.len() - 1).unwrap_or(u32::MAX)
                    })
                };
                // A polygon is split into a fan, as by all readers; a point or a line has no surface. Only vertices of faces are
                // kept: the others would still count in a convex hull.
                let corners: Vec<u32> = if corners.len() < 3 {
                    Vec::new()
                } else {
                    corners.into_iter().map(&mut place).collect()
                };
                for edge in corners.get(1..).unwrap_or_default().windows(2) {
                    mesh.triangles.push([corners[0], edge[0], edge[1]]);
                }
            }
            _ => {}
        }
    }
    Ok(mesh)
}

fn vertex<'a>(words: impl Iterator<Item = &'a str>) -> Option<Point3<f64>> {
    let mut numbers = words.map(|word| word.parse::<f64>().ok());
    let mut next = || numbers.next().flatten();
    Some(Point3::new(next()?, next()?, next()?))
}

/// The vertex of a corner `vertex/texture/normal`: from 1, or from the last one back if it is negative.
fn corner(word: &str, vertices: usize) -> Result<usize, String> {
    let written = word.split('/').next().unwrap_or_default();
    let index: i64 = written
        .parse()
        .map_err(|_| format!("\"{word}\" is not a vertex of a face (expected v, v/vt, v//vn or v/vt/vn)"))?;
    let back = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
    // From 1 on, or backwards from the last vertex so far (-1): 0 is neither and fails `checked_sub`.
    let found = if index > 0 { back.checked_sub(1) } else { vertices.checked_sub(back) };
    found
        .filter(|&found| found < vertices)
        .ok_or_else(|| format!("vertex index {index} is out of range: there are {vertices} vertices"))
}

fn material_libraries(text: &str) -> Vec<String> {
    text.lines()
        .filter_map(|line| line.trim().strip_prefix("mtllib "))
        .map(|name| name.trim().to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\n";

    #[test]
    fn polygons_become_triangles_with_all_digits() {
        let text = format!("{SQUARE}f 1 2 3 4\no second\nf -4 -3 -2\n");
        let mesh = parse(text.as_bytes()).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
        assert_eq!(mesh.vertices_m[3], Point3::new(0.0, 1.0, 0.1));
        assert_eq!(mesh.material_libraries, ["a.mtl"]);
    }

    #[test]
    fn an_index_out_of_range_is_named_with_its_line() {
        let message = parse(format!("{SQUARE}f 1 2 999").as_bytes()).unwrap_err().to_string();
        assert_eq!(message, "line 6: vertex index 999 is out of range: there are 4 vertices");
        assert!(parse(format!("{SQUARE}f 1 2 0").as_bytes()).is_err());
        assert!(parse(b"v a b c").is_err());
        assert!(parse(format!("{SQUARE}f 1 2 x").as_bytes()).is_err());
    }

    #[test]
    fn vertices_of_no_face_are_left_out_and_odd_textures_are_nothing() {
        let mesh = parse(format!("{SQUARE}v 9 9 9\nf 1 2\nf 4/-101/1 3/x 2//\n").as_bytes()).unwrap();
        assert_eq!((mesh.vertices_m.len(), mesh.triangles), (3, vec![[0, 1, 2]]));
        assert_eq!(mesh.vertices_m[0], Point3::new(0.0, 1.0, 0.1));
    }

    #[test]
    fn cut_files_never_panic() {
        let whole = format!("{SQUARE}f 1 2 3 4\nf -1/1/1 -2//1 -3/ 4\n");
        for end in 0..whole.len() {
            let _ = parse(&whole.as_bytes()[..end]);
        }
    }
}
