//! The meshes of a model, each read once, in the frame of its file.

use std::{path::PathBuf, sync::Arc};

use congruent_input::{Diagnostic, Diagnostics};
use congruent_meshes::{FindMesh, FoundMesh, Mesh, hull_triangles};
use congruent_mjcf::{MeshMass, MjMesh, MjMeshInertia, MjModel, mesh_mass};
use nalgebra::{Isometry3, Point3, Translation3};

use super::placed::placed;
use crate::codes;

/// A mesh that was looked for: the mesh, scaled but not moved if [`scaled_from_mesh`] does that, or why there is none.
type FoundOnce = Result<Arc<Mesh>, Diagnostic>;

/// Finds meshes, each once.
pub(super) struct ModelMeshes<'a, 'm> {
    model: &'a MjModel,
    find_mesh: &'a mut FindMesh<'m>,
    found: Vec<Option<FoundOnce>>,
}

impl<'a, 'm> ModelMeshes<'a, 'm> {
    pub(super) fn new(model: &'a MjModel, find_mesh: &'a mut FindMesh<'m>) -> Self {
        Self { model, find_mesh, found: vec![None; model.meshes.len()] }
    }

    /// A mesh, scaled; [`scaled_from_mesh`] has the rest of its placement.
    pub(super) fn find(&mut self, index: usize, diagnostics: &mut Diagnostics) -> FoundOnce {
        if let Some(found) = &self.found[index] {
            return found.clone();
        }
        let mesh = &self.model.meshes[index];
        let found = match &mesh.file {
            Some(file) => {
                (self.find_mesh)(&file.value, mesh.scale.value).map(|FoundMesh { mesh, warnings }| {
                    let at = file.place.as_ref();
                    let warnings = warnings.into_iter();
                    diagnostics.extend(warnings.map(|warning| match at {
                        Some(place) => placed(warning, place),
                        None => warning,
                    }));
                    mesh
                })
            }
            None => inline(mesh),
        };
        let found = found.map(|scaled| moved(mesh, scaled));
        // At the mesh, not at each geom that uses it: the file is named there.
        let found = found.map_err(|fault| {
            placed(fault, mesh.file.as_ref().and_then(|file| file.place.as_ref()).unwrap_or(&mesh.place))
        });
        self.found[index] = Some(found.clone());
        found
    }

    /// Amount and inertia of a mesh.
    pub(super) fn mass(
        &mut self,
        index: usize,
        diagnostics: &mut Diagnostics,
    ) -> Result<MeshMass, Diagnostic> {
        let found = self.find(index, diagnostics)?;
        let mesh = &self.model.meshes[index];
        let mesh_from_scaled = scaled_from_mesh(mesh).inverse();
        let corners: Vec<Point3<f64>> =
            found.vertices_m.iter().map(|vertex| mesh_from_scaled * vertex).collect();
        let is_mirrored = mesh.scale.value.product() < 0.0;
        let triangles: Vec<[Point3<f64>; 3]> = if mesh.inertia == MjMeshInertia::Convex {
            hull_triangles(&corners).into_iter().map(|of| of.map(|corner| corners[corner])).collect()
        } else {
            // The corners of a mirrored mesh were swapped to keep its outside out; the rule of inertia wants them as in the file.
            let order = |[a, b, c]: [u32; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
            found.triangles.iter().map(|of| order(*of).map(|corner| corners[corner as usize])).collect()
        };
        mesh_mass(mesh, &triangles)
    }
}

/// The frame of a mesh in that of its scaled vertices: [`MjMesh::vertex`] without the scale. The identity if the scale distorts what
/// was turned: its vertices are moved then.
pub(super) fn scaled_from_mesh(mesh: &MjMesh) -> Isometry3<f64> {
    if is_distorted(mesh) {
        return Isometry3::identity();
    }
    let scaled = mesh.reference_pos.component_mul(&mesh.scale.value);
    Isometry3::from_parts(Translation3::from(scaled), mesh.reference_orientation)
}

/// Whether a turn before the scale is none behind it.
fn is_distorted(mesh: &MjMesh) -> bool {
    let scale = mesh.scale.value;
    mesh.reference_orientation.angle() > 0.0 && scale.add_scalar(-scale.x).amax() > 0.0
}

/// A mesh of scaled vertices; one that is distorted is no longer that of its file.
fn moved(mesh: &MjMesh, scaled: Arc<Mesh>) -> Arc<Mesh> {
    if !is_distorted(mesh) {
        return scaled;
    }
    let vertex = |of: &Point3<f64>| mesh.vertex(Point3::from(of.coords.component_div(&mesh.scale.value)));
    let vertices_m = scaled.vertices_m.iter().map(vertex).collect();
    Arc::new(Mesh { path: PathBuf::new(), vertices_m, ..(*scaled).clone() })
}

/// A mesh whose vertices are in the model; without faces it is their convex hull.
fn inline(mesh: &MjMesh) -> FoundOnce {
    let scaled = |vertex: &Point3<f64>| Point3::from(vertex.coords.component_mul(&mesh.scale.value));
    let vertices_m: Vec<Point3<f64>> = mesh.vertices.iter().map(scaled).collect();
    let faces = if mesh.faces.is_empty() { hull_triangles(&vertices_m) } else { mesh.faces.clone() };
    if faces.is_empty() {
        let message = format!("mesh \"{}\" has neither a file nor vertices with a volume", mesh.name);
        return Err(Diagnostic::error(codes::mjcf::MESH, message));
    }
    let is_mirrored = mesh.scale.value.product() < 0.0 && !mesh.faces.is_empty();
    #[expect(clippy::cast_possible_truncation, reason = "a file has fewer vertices than 2^32")]
    let triangle = |face: &[usize; 3]| {
        let [a, b, c] = face.map(|corner| corner as u32);
        if is_mirrored { [a, c, b] } else { [a, b, c] }
    };
    let triangles = faces.iter().map(triangle).collect();
    Ok(Arc::new(Mesh { path: PathBuf::new(), scale: mesh.scale.value, triangles, vertices_m }))
}
