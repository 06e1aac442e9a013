//! STL, binary and ASCII, by `stl_io`; count, header and encoding, which it takes on trust, are checked
//! first.

use std::io::Cursor;

use nalgebra::Point3;

use super::mesh_file::{MeshError, MeshFile};

/// Length of the header: 80 bytes of free text, then the number of triangles.
const HEADER_BYTES: usize = 84;
/// Length of a triangle: a normal and three corners of three floats each, two bytes of attributes.
const TRIANGLE_BYTES: usize = 50;

pub(super) fn parse(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let mesh = if let Some(ascii) = ascii(bytes) {
        stl_io::read_stl(&mut Cursor::new(ascii))
    } else {
        let mut binary = bytes[..binary_length(bytes)?].to_vec();
        // Some exporters begin the free text with the keyword of the ASCII form.
        binary[0] = b' ';
        stl_io::read_stl(&mut Cursor::new(binary))
    };
    let mesh = mesh.map_err(|error| MeshError::Format { what: error.to_string() })?;
    // An STL of more than 2^32 corners is over the limit of any file.
    let index = |corner: usize| u32::try_from(corner).unwrap_or(u32::MAX);
    Ok(MeshFile {
        vertices_m: mesh.vertices.iter().map(|vertex| Point3::from(vertex.0).cast()).collect(),
        triangles: mesh.faces.iter().map(|face| face.vertices.map(index)).collect(),
        material_libraries: Vec::new(),
    })
}

fn count(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(HEADER_BYTES - 4..)?.first_chunk()?))
}

/// Length of the binary STL at the beginning of `bytes`. Padding after the last triangle is accepted; padding of exactly whole
/// triangles means that the count in the header is wrong.
fn binary_length(bytes: &[u8]) -> Result<usize, MeshError> {
    let promised = count(bytes).ok_or(MeshError::TooShort { bytes: bytes.len() })?;
    // `get` in `count` has found a header, so the difference is not negative.
    let held = (bytes.len() - HEADER_BYTES) / TRIANGLE_BYTES;
    if promised as usize > held {
        return Err(MeshError::Truncated { promised, held });
    }
    // A rest that is no whole number of triangles is text after the data, which exporters append.
    let is_exact = bytes.len() == HEADER_BYTES + held * TRIANGLE_BYTES;
    if is_exact && (promised as usize) < held {
        return Err(MeshError::Surplus { promised, held });
    }
    Ok(HEADER_BYTES + promised as usize * TRIANGLE_BYTES)
}

/// The text of an ASCII STL, its first line in the one form that `stl_io` knows.
///
/// `solid` alone proves nothing: binary files begin with it too, but their length fits their count.
fn ascii(bytes: &[u8]) -> Option<Vec<u8>> {
    let fits = |count: u32| bytes.len() == HEADER_BYTES + count as usize * TRIANGLE_BYTES;
    let text = bytes.trim_ascii_start().strip_prefix(b"solid")?;
    if count(bytes).is_some_and(fits) || text.contains(&0) {
        return None;
    }
    let after_name = text.iter().position(|&byte| byte == b'\n').map_or(&text[..0], |end| &text[end..]);
    // The name is replaced: `stl_io` wants one word, files have none or several.
    Some([b"solid mesh", after_name].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ASCII: &str = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                         vertex 0 1 0\nendloop\nendfacet\nendsolid\n";

    fn binary(header: &str, promised: u32, corners: &[[f32; 3]]) -> Vec<u8> {
        let mut bytes = header.as_bytes().to_vec();
        bytes.resize(HEADER_BYTES - 4, 0);
        bytes.extend(promised.to_le_bytes());
        for triangle in corners.chunks(3) {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|coordinate| coordinate.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[track_caller]
    fn one_triangle(bytes: &[u8]) {
        let mesh = parse(bytes).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert_eq!(mesh.vertices_m, CORNERS.map(|corner| Point3::from(corner).cast()));
    }

    #[test]
    fn both_forms_load() {
        one_triangle(&binary("made by hand", 1, &CORNERS));
        one_triangle(&binary("solid all the same", 1, &CORNERS));
        one_triangle(&[binary("padded", 1, &CORNERS), vec![0; 7]].concat());
        one_triangle(ASCII.as_bytes());
        one_triangle(ASCII.replace("solid\nfacet", "  solid a b\nfacet").as_bytes());
    }

    #[test]
    fn a_count_that_the_length_denies_is_refused() {
        let truncated = |promised, held| Err(MeshError::Truncated { promised, held });
        assert_eq!(parse(&binary("", 2, &CORNERS)), truncated(2, 1));
        assert_eq!(parse(&binary("", u32::MAX, &CORNERS)), truncated(u32::MAX, 1));
        assert_eq!(
            parse(&binary("", 1, &[CORNERS, CORNERS].concat())),
            Err(MeshError::Surplus { promised: 1, held: 2 })
        );
        assert_eq!(parse(b"0123456789"), Err(MeshError::TooShort { bytes: 10 }));
        assert_eq!(parse(b""), Err(MeshError::TooShort { bytes: 0 }));
    }

    #[test]
    fn cut_files_never_panic() {
        for whole in [binary("solid", 1, &CORNERS), ASCII.as_bytes().to_vec()] {
            for end in 0..whole.len() {
                let _ = parse(&whole[..end]);
            }
        }
    }
}
