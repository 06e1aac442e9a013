//! Wavefront OBJ by `tobj`, which is given bytes and a material loader that opens nothing.

use nalgebra::Point3;

use super::mesh_file::{MeshError, MeshFile};

pub(super) fn parse(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    let no_materials = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| index_fault(&text).unwrap_or(MeshError::Format { what: error.to_string() }))?;
    let mut mesh = MeshFile { material_libraries: material_libraries(&text), ..MeshFile::default() };
    for model in models {
        let first = u32::try_from(mesh.vertices_m.len()).unwrap_or(u32::MAX);
        let corners = model.mesh.indices.chunks_exact(3);
        mesh.triangles.extend(corners.map(|c| [c[0], c[1], c[2]].map(|index| first.saturating_add(index))));
        mesh.vertices_m.extend(model.mesh.positions.chunks_exact(3).map(Point3::from_slice));
    }
    Ok(mesh)
}

fn material_libraries(text: &str) -> Vec<String> {
    text.lines()
        .filter_map(|line| line.trim().strip_prefix("mtllib "))
        .map(|name| name.trim().to_owned())
        .collect()
}

/// The first face that names a vertex that is not there: `tobj` does not say which.
fn index_fault(text: &str) -> Option<MeshError> {
    let mut vertices = 0;
    for (line, words) in text.lines().enumerate().map(|(line, text)| (line + 1, text.split_whitespace())) {
        let mut words = words;
        match words.next() {
            Some("v") => vertices += 1,
            Some("f") => {
                let index = |word: &str| word.split('/').next().and_then(|index| index.parse::<i64>().ok());
                let out = |index: &i64| *index == 0 || index.abs() > vertices;
                if let Some(index) = words.filter_map(index).find(out) {
                    let what = format!("vertex index {index} is out of range: there are {vertices} vertices");
                    return Some(MeshError::Line { line, what });
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.1\n";

    #[test]
    fn polygons_become_triangles_with_all_digits() {
        let text = format!("{SQUARE}f 1 2 3 4\no second\nf -4 -3 -2\n");
        let mesh = parse(text.as_bytes()).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [4, 5, 6]]);
        assert_eq!(mesh.vertices_m[3], Point3::new(0.0, 1.0, 0.1));
        assert_eq!(mesh.material_libraries, ["a.mtl"]);
    }

    #[test]
    fn an_index_out_of_range_is_named_with_its_line() {
        let message = parse(format!("{SQUARE}f 1 2 999").as_bytes()).unwrap_err().to_string();
        assert_eq!(message, "line 6: vertex index 999 is out of range: there are 4 vertices");
        assert!(parse(format!("{SQUARE}f 1 2 0").as_bytes()).is_err());
        assert!(parse(b"v a b c").is_err());
    }

    #[test]
    fn cut_files_never_panic() {
        let whole = format!("{SQUARE}f 1 2 3 4\nf -1/1/1 -2//1 -3/ 4\n");
        for end in 0..whole.len() {
            let _ = parse(&whole.as_bytes()[..end]);
        }
    }
}
