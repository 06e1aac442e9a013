//! Mesh files to triangles: STL, OBJ and COLLADA. Bytes in, checked triangles out; only `store.rs`
//! reads files, and a material library that a mesh names is never read.

pub mod codes;
mod dae;
mod format;
mod hull;
mod mesh;
mod mesh_file;
mod obj;
mod stl;
mod store;

pub use hull::{HullPoints, hull_triangles};
pub use mesh::Mesh;
pub use store::{FindMesh, FoundMesh, MeshStore, read_mesh};
