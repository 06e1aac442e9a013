//! The meshes of an MJCF, each once by file and scale.

use std::{collections::BTreeSet, path::Path, sync::Arc};

use congruent_description::{Geometry, Mesh, Robot};

use crate::{
    mesh_file::file_name,
    xml_text::{Attributes, XmlText},
};

/// Meshes with the names that geoms call them by.
pub(super) struct Assets(Vec<(Arc<Mesh>, String)>);

impl Assets {
    pub(super) fn of_robot(robot: &Robot) -> Self {
        let mut assets = Self(Vec::new());
        let mut taken = BTreeSet::new();
        for shape in robot.links().iter().flat_map(|link| link.visuals.iter().chain(&link.collisions)) {
            let Geometry::Mesh(mesh) = &shape.geometry else { continue };
            if assets.name(mesh).is_none() {
                let stem = mesh.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let wanted = if stem.is_empty() { "mesh".to_owned() } else { stem };
                let numbered = (2..).map(|number| format!("{wanted}_{number}"));
                let mut names = std::iter::once(wanted.clone()).chain(numbered);
                let name = names.find(|name| !taken.contains(name)).unwrap_or_default();
                taken.insert(name.clone());
                assets.0.push((Arc::clone(mesh), name));
            }
        }
        assets
    }

    /// The name of a mesh.
    pub(super) fn name(&self, mesh: &Mesh) -> Option<&str> {
        let is_same = |of: &Mesh| {
            of.path == mesh.path
                && of.scale == mesh.scale
                && (!mesh.path.as_os_str().is_empty() || of.vertices_m == mesh.vertices_m)
        };
        self.0.iter().find(|(of, _)| is_same(of)).map(|(_, name)| name.as_str())
    }

    pub(super) fn write(&self, text: &mut XmlText, folder: &Path) {
        if self.0.is_empty() {
            return;
        }
        text.begin("asset", Attributes::default());
        for (mesh, name) in &self.0 {
            let named = Attributes::default().text("name", name);
            text.element(
                "mesh",
                match file_name(mesh, folder) {
                    Some(file) => named.text("file", &file).numbers("scale", mesh.scale.iter().copied()),
                    None => inline(named, mesh),
                },
            );
        }
        text.end();
    }
}

/// A mesh without a file: its vertices, which are scaled already, and its triangles.
fn inline(named: Attributes, mesh: &Mesh) -> Attributes {
    let vertices = mesh.vertices_m.iter().flat_map(|vertex| [vertex.x, vertex.y, vertex.z]);
    let faces: Vec<String> = mesh.triangles.iter().map(|[a, b, c]| format!("{a} {b} {c}")).collect();
    named.numbers("vertex", vertices).text("face", &faces.join(" "))
}
