//! The meshes of one robot: each file is read once for each scale and shared.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Diagnostic, FileAccess, Packages, Resolved, units::LARGEST};
use nalgebra::{Point3, Vector3};

use super::{
    format::MeshFormat,
    mesh_file::{MeshError, MeshFile},
};
use crate::{codes, mesh::Mesh};

/// Size limit of a mesh file, bytes.
const MESH_BYTES: u64 = 256 << 20;

/// A mesh with its warnings, which come only when its file is read for the first time.
pub struct FoundMesh {
    /// The mesh.
    pub mesh: Arc<Mesh>,
    /// What is suspicious in its file.
    pub warnings: Vec<Diagnostic>,
}

/// Gives the mesh that a URDF names, scaled.
pub type FindMesh<'a> = dyn FnMut(&str, Vector3<f64>) -> Result<FoundMesh, Diagnostic> + 'a;

/// Reads meshes inside the folders that `packages` allows.
pub struct MeshStore<'a> {
    packages: &'a mut Packages,
    access: &'a FileAccess,
    /// Meshes that were read, by file and the bits of their scale: floats are no ordered keys.
    read: BTreeMap<(PathBuf, [u64; 3]), Arc<Mesh>>,
}

impl<'a> MeshStore<'a> {
    /// A store without meshes.
    pub fn new(packages: &'a mut Packages, access: &'a FileAccess) -> Self {
        Self { packages, access, read: BTreeMap::new() }
    }

    /// The mesh that a URDF names by `uri`, in metres, scaled.
    ///
    /// # Errors
    /// The file is not found, may not be opened, or is no mesh.
    pub fn find(&mut self, uri: &str, scale: Vector3<f64>) -> Result<FoundMesh, Diagnostic> {
        let Resolved { path, warning } = self.packages.resolve(uri)?;
        // By bits, since floats have no total order; a scale that differs in the last bit is read twice, which is
        // harmless.
        let key = (path.clone(), scale.map(f64::to_bits).into());
        if let Some(mesh) = self.read.get(&key) {
            return Ok(FoundMesh { mesh: Arc::clone(mesh), warnings: warning.into_iter().collect() });
        }
        let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        let is_foreign = self.access.is_foreign(&path);
        let refused = |error: MeshError| {
            // The words of an error may be those of the file.
            let why =
                if is_foreign { format!("not a mesh in the format {extension}") } else { error.to_string() };
            Diagnostic::error(codes::mesh::INVALID, format!("mesh \"{uri}\": {why}"))
                .one_of("mesh files cannot be used", uri)
        };
        // The format is checked by the extension first, so that a file of an unsupported format is never opened.
        let format = MeshFormat::from_extension(&extension).map_err(refused)?;
        let read = format.parse(&self.access.read_mesh(uri, &path, MESH_BYTES)?).map_err(refused)?;
        let mut warnings = self.warnings(uri, &path, &read);
        warnings.extend(warning);
        let mesh = Arc::new(scaled(path, read, scale).map_err(refused)?);
        self.read.insert(key, Arc::clone(&mesh));
        Ok(FoundMesh { mesh, warnings })
    }

    fn warnings(&self, uri: &str, path: &std::path::Path, mesh: &MeshFile) -> Vec<Diagnostic> {
        let folder = path.parent().unwrap_or(path);
        let outside = |library: &&String| !self.packages.allows(&folder.join(library));
        let outside_project = |library: &String| {
            let message = format!("mesh \"{uri}\": mtllib \"{library}\" is outside of the project folder");
            Diagnostic::warning(codes::mesh::MATERIAL_OUTSIDE, message)
                .with_help("material libraries are never read; remove the line")
        };
        let mut warnings: Vec<_> =
            mesh.material_libraries.iter().filter(outside).map(outside_project).collect();
        if mesh.triangles.is_empty() {
            let message = format!("mesh \"{uri}\": the scene is empty, so the link gets no shape from it");
            warnings.push(
                Diagnostic::warning(codes::mesh::EMPTY, message)
                    .one_of("meshes are empty scenes, so their links get no shape from them", uri),
            );
        }
        warnings
    }
}

/// The mesh that another file in `folder` names, scaled; nothing outside of its project and of what `access` allows is
/// opened.
///
/// # Errors
/// The file cannot be found or read, is outside of the project folder, or is no mesh.
pub fn read_mesh(
    folder: &Path,
    uri: &str,
    scale: Vector3<f64>,
    access: &FileAccess,
) -> Result<Arc<Mesh>, Diagnostic> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut packages = Packages::new(folder, BTreeMap::new(), access).map_err(|error| {
        Diagnostic::error(
            congruent_input::codes::file::UNREADABLE,
            format!("{} cannot be read: {error}", folder.display()),
        )
    })?;
    let found = MeshStore::new(&mut packages, access).find(uri, scale).map_err(|fault| {
        if fault.code != congruent_input::codes::mesh::OUTSIDE {
            return fault;
        }
        fault.with_help("put the mesh into the project folder, the only folder that is read")
    })?;
    if found.mesh.triangles.is_empty() {
        return Err(Diagnostic::error(codes::mesh::EMPTY, format!("mesh \"{uri}\": the scene is empty")));
    }
    Ok(found.mesh)
}

fn scaled(path: PathBuf, mesh: MeshFile, scale: Vector3<f64>) -> Result<Mesh, MeshError> {
    let vertices_m: Vec<_> =
        mesh.vertices_m.iter().map(|vertex| Point3::from(vertex.coords.component_mul(&scale))).collect();
    // After scaling: a mesh in millimetres may have coordinates of 1e5.
    let furthest_m = vertices_m.iter().fold(0.0, |furthest: f64, vertex| furthest.max(vertex.coords.amax()));
    if furthest_m > LARGEST {
        return Err(MeshError::TooFar { furthest_m });
    }
    let mut triangles = mesh.triangles;
    // An odd number of negative factors is a reflection, which turns the surface inside out: two corners are swapped back.
    if scale.iter().filter(|factor| **factor < 0.0).count() % 2 == 1 {
        for corners in &mut triangles {
            corners.swap(1, 2);
        }
    }
    Ok(Mesh { path, scale, vertices_m, triangles })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    #[test]
    fn a_file_is_read_once_for_each_scale_and_mirroring_keeps_the_outside_out() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.obj"), TRIANGLE).unwrap();
        let access = FileAccess::default();
        let mut packages = Packages::new(folder.path(), BTreeMap::new(), &access).unwrap();
        let mut store = MeshStore::new(&mut packages, &access);
        let mut find = |scale| store.find("a.obj", scale).unwrap().mesh;
        let once = Vector3::new(1.0, 1.0, 1.0);
        assert!(Arc::ptr_eq(&find(once), &find(once)));
        let mirrored = find(Vector3::new(-2.0, 1.0, 1.0));
        assert_eq!(mirrored.vertices_m[1], Point3::new(-2.0, 0.0, 0.0));
        assert_eq!(mirrored.triangles, [[0, 2, 1]]);
        let far = store.find("a.obj", Vector3::repeat(1e300)).err().map(|fault| fault.message);
        let expected = "mesh \"a.obj\": a vertex is 1.0e300 m away from the origin (limit 1e6 m)";
        assert_eq!(far.as_deref(), Some(expected));
    }

    #[test]
    fn a_material_library_outside_is_a_warning() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.obj"), format!("mtllib /etc/hosts\nmtllib b.mtl\n{TRIANGLE}"))
            .unwrap();
        let access = FileAccess::default();
        let mut packages = Packages::new(folder.path(), BTreeMap::new(), &access).unwrap();
        let found =
            MeshStore::new(&mut packages, &access).find("a.obj", Vector3::new(1.0, 1.0, 1.0)).unwrap();
        let messages: Vec<_> = found.warnings.into_iter().map(|warning| warning.message).collect();
        assert_eq!(messages, ["mesh \"a.obj\": mtllib \"/etc/hosts\" is outside of the project folder"]);
    }
}
