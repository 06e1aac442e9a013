//! A mesh in memory.

use std::path::PathBuf;

use nalgebra::{Point3, Vector3};

/// A triangle mesh in metres: file unit, up axis and the `scale` of the description are applied.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The file it was read from; empty if its vertices are in the description itself.
    pub path: PathBuf,
    /// The `scale` of the description, which is in the vertices: whoever names the file again needs it.
    pub scale: Vector3<f64>,
    /// Vertices in the shape's frame.
    pub vertices_m: Vec<Point3<f64>>,
    /// Corners of the triangles, indices into `vertices_m`, each in range.
    pub triangles: Vec<[u32; 3]>,
}
