//! Meshes: which file or which vertices, and how they become lengths. No file is opened here.

use congruent_input::{Diagnostic, known_names};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{
    attributes::MjAttributes,
    geom::points,
    names::{MjCopy, MjNamed},
    orientation::SHORTEST,
    reader::MjReader,
};
use crate::{
    codes,
    document::{MjElement, folder},
    model::{MjMesh, MjMeshInertia, MjWritten},
    settings::MjSettings,
};

/// Fewest vertices of a mesh that is given inline.
const FEWEST_VERTICES: usize = 4;

impl MjReader<'_, '_> {
    /// The meshes of a model; `None` above a bound.
    pub(super) fn meshes(&mut self, attachment: usize) -> Option<()> {
        let scope = self.scope(attachment);
        for element in scope.root.in_sections("asset").filter(|asset| asset.tag == "mesh") {
            self.count(element)?;
            let attributes = self.attributes(element, attachment);
            let file = attributes.find("file").map(|found| MjWritten {
                value: path(&found.attribute.value, &scope.settings, &scope.folder),
                place: Some(found.place()),
            });
            let mesh = self.mesh(&attributes, file);
            let local = local_name(element).unwrap_or_default().to_owned();
            let name = self.full_name(attachment, "", &local);
            let taken = self.names.take(MjNamed::Mesh, &name, element);
            self.diagnostics.keep(taken);
            let copy = MjCopy { replica: String::new(), index: self.model.meshes.len() };
            self.names.add(attachment, MjNamed::Mesh, &local, copy);
            self.model.meshes.push(MjMesh { name, ..mesh });
        }
        Some(())
    }

    fn mesh(&mut self, attributes: &MjAttributes<'_>, file: Option<MjWritten<String>>) -> MjMesh {
        let element = attributes.element;
        let numbers = |key: &str| attributes.find(key).map(|found| found.numbers()).unwrap_or_default();
        let vertices = points(&numbers("vertex"));
        let is_built_in = attributes.find("builtin").is_some_and(|found| found.attribute.value != "none");
        if file.is_none() && !is_built_in && vertices.len() < FEWEST_VERTICES {
            let message = format!("{} has neither a file nor {FEWEST_VERTICES} vertices", element.label());
            self.diagnostics.push(element.fault(codes::mjcf::GEOM, message).with_help("file=\"part.stl\""));
        }
        let faces = faces(attributes, vertices.len());
        let [w, x, y, z] = attributes.array("refquat", [1.0, 0.0, 0.0, 0.0]).value;
        let turned = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), SHORTEST).ok_or_else(|| {
            let message = format!("{}: the quaternion of refquat has the length 0", element.label());
            element.fault_at("refquat", codes::mjcf::ORIENTATION, message)
        });
        MjMesh {
            name: String::new(),
            file,
            faces: self.diagnostics.keep(faces).unwrap_or_default(),
            vertices,
            scale: attributes.array("scale", [1.0; 3]).map(Vector3::from),
            reference_pos: Vector3::from(attributes.array("refpos", [0.0; 3]).value),
            reference_orientation: self.diagnostics.keep(turned).unwrap_or_default(),
            inertia: match attributes.text("inertia") {
                Some("convex") => MjMeshInertia::Convex,
                Some("exact") => MjMeshInertia::Exact,
                Some("shell") => MjMeshInertia::Shell,
                _ => MjMeshInertia::Legacy,
            },
            place: element.place(),
        }
    }

    /// The mesh that a geom names.
    pub(super) fn mesh_called(
        &mut self,
        name: &str,
        attributes: &MjAttributes<'_>,
        attachment: usize,
    ) -> Option<usize> {
        if let [copy, ..] = self.names.copies(attachment, MjNamed::Mesh, name) {
            return Some(copy.index);
        }
        let meshes = self.scope(attachment).root.in_sections("asset").filter(|asset| asset.tag == "mesh");
        let known: Vec<&str> = meshes.filter_map(local_name).collect();
        let message = format!("{}: there is no mesh \"{name}\"", attributes.element.label());
        let found = attributes.find("mesh")?;
        let fault = found.attribute.fault(codes::mjcf::UNKNOWN_NAME, message);
        self.diagnostics.push(fault.with_help(known_names(name, "meshes", known)));
        None
    }
}

/// The name of a mesh: that of its file without folder and ending if it has none.
fn local_name(element: &MjElement) -> Option<&str> {
    element.name().or_else(|| {
        let file = element.text("file")?;
        let bare = &file[folder(file).len()..];
        Some(bare.rsplit_once('.').map_or(bare, |(stem, _)| stem))
    })
}

/// The path of a mesh: relative to the folder of the model's main file, with `meshdir` before it.
fn path(file: &str, settings: &MjSettings, model_folder: &str) -> String {
    let file = if settings.is_path_stripped { &file[folder(file).len()..] } else { file };
    let mesh_folder = settings.mesh_folder.trim_end_matches('/');
    let slash = if settings.mesh_folder.is_empty() { "" } else { "/" };
    if file.starts_with('/') {
        file.to_owned()
    } else if mesh_folder.starts_with('/') || settings.mesh_folder.starts_with('/') {
        format!("{mesh_folder}/{file}")
    } else {
        format!("{model_folder}{mesh_folder}{slash}{file}")
    }
}

fn faces(attributes: &MjAttributes<'_>, vertices: usize) -> Result<Vec<[usize; 3]>, Diagnostic> {
    let Some(found) = attributes.find("face") else { return Ok(Vec::new()) };
    let text = &found.attribute.value;
    let indices: Vec<Option<usize>> =
        text.split_whitespace().map(|token| token.parse().ok().filter(|index| *index < vertices)).collect();
    let owner = attributes.element.label();
    let fault = |message: String| found.attribute.fault(codes::mjcf::GEOM, message);
    if !indices.len().is_multiple_of(3) {
        return Err(fault(format!("{owner}: face has {} indices, no multiple of 3", indices.len())));
    }
    let Some(indices) = indices.into_iter().collect::<Option<Vec<usize>>>() else {
        return Err(fault(format!(
            "{owner}: face has an index that is not 0 to {}",
            vertices.saturating_sub(1)
        )));
    };
    Ok(indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect())
}
