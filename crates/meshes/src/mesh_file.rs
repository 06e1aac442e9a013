//! What a mesh file holds, whatever its format, and what may be wrong with it.

use congruent_input::units::LARGEST;
use nalgebra::{Point3, Vector3};

/// The contents of a mesh file, in metres and in the file's own axes.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct MeshFile {
    pub(crate) vertices_m: Vec<Point3<f64>>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Material libraries that the file names.
    pub(crate) material_libraries: Vec<String>,
}

/// The reason why bytes are not a usable mesh.
#[derive(Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub(crate) enum MeshError {
    /// The file name's extension is none of the three.
    #[error("mesh format \"{extension}\" is not supported (use STL, OBJ or DAE)")]
    Unsupported { extension: String },
    /// The file is a Git LFS pointer instead of the mesh.
    #[error("it is a Git LFS pointer, not the mesh itself: `git lfs pull` fetches it")]
    LfsPointer,
    /// The file has no bytes, or only white space.
    #[error("the file is empty")]
    Empty,
    /// Fewer bytes than any STL has.
    #[error("{bytes} bytes are too short for an STL file, whose header alone is 84")]
    TooShort { bytes: usize },
    /// The count in the header and the length of the file disagree.
    #[error("the file is truncated: its header declares {promised} triangles, but it holds only {held}")]
    Truncated { promised: u32, held: usize },
    /// The header promises fewer triangles than the file holds.
    #[error("the header declares {promised} triangles, but the file holds {held}: the others are ignored")]
    Surplus { promised: u32, held: usize },
    /// A fault with its line.
    #[error("line {line}: {what}")]
    Line { line: usize, what: String },
    /// A fault that the reader of the format describes.
    #[error("{what}")]
    Format { what: String },
    /// A corner refers to a vertex index beyond the list of vertices.
    #[error("triangle {triangle} uses vertex index {index}, out of range: there are {vertices} vertices")]
    Index { triangle: usize, index: u32, vertices: usize },
    /// A coordinate is NaN or infinite.
    #[error("triangle {triangle} has a vertex that is not finite")]
    NotFinite { triangle: usize },
    /// No machine is so large, and squares of such numbers overflow.
    #[error("a vertex is {furthest_m:.1e} m away from the origin (limit {LARGEST:e} m)")]
    TooFar { furthest_m: f64 },
    /// All triangles are degenerate, or there are none.
    #[error("no triangle has area")]
    NoArea,
}

impl MeshFile {
    /// Refuses vertex indices out of range, coordinates that are not finite, and meshes without area.
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let mut has_area = false;
        for (triangle, corners) in self.triangles.iter().enumerate() {
            let vertices = self.vertices_m.len();
            if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
                return Err(MeshError::Index { triangle, index, vertices });
            }
            let [a, b, c] = corners.map(|index| self.vertices_m[index as usize]);
            if [a, b, c].iter().any(|corner| !corner.coords.iter().all(|coordinate| coordinate.is_finite())) {
                return Err(MeshError::NotFinite { triangle });
            }
            // Exactly zero: a mesh may be tiny, and exporters write degenerate triangles among good ones.
            has_area |= (b - a).cross(&(c - a)) != Vector3::zeros();
        }
        if has_area { Ok(()) } else { Err(MeshError::NoArea) }
    }
}

/// A polygon as a fan of triangles around its first corner.
pub(super) fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    corners.windows(2).skip(1).map(|edge| [corners[0], edge[0], edge[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(vertices_m: Vec<Point3<f64>>, triangle: [u32; 3]) -> MeshFile {
        MeshFile { vertices_m, triangles: vec![triangle], ..MeshFile::default() }
    }

    #[test]
    fn geometry_is_checked_before_use() {
        let corners = vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
        let mut broken = corners.clone();
        broken[2].z = f64::NAN;
        assert_eq!(mesh(corners.clone(), [0, 1, 2]).check(), Ok(()));
        assert_eq!(mesh(corners.clone(), [0, 1, 1]).check(), Err(MeshError::NoArea));
        assert_eq!(
            mesh(corners, [0, 1, 3]).check(),
            Err(MeshError::Index { triangle: 0, index: 3, vertices: 3 })
        );
        assert_eq!(mesh(broken, [0, 1, 2]).check(), Err(MeshError::NotFinite { triangle: 0 }));
        assert_eq!(MeshFile::default().check(), Err(MeshError::NoArea));
    }

    #[test]
    fn a_polygon_is_a_fan() {
        assert_eq!(fan(&[4, 5, 6, 7]).collect::<Vec<_>>(), [[4, 5, 6], [4, 6, 7]]);
        assert_eq!(fan(&[4, 5]).count(), 0);
        assert_eq!(fan(&[]).count(), 0);
    }
}
