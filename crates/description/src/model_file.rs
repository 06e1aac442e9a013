//! Reads the file that describes links and joints, a URDF or an MJCF: which of them it is, its root element says.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::PathBuf,
    sync::Arc,
};

use congruent_input::{
    Diagnostic, Diagnostics, FileAccess, Findings, Packages, SourceFile, TextKind, folder_of,
};
use congruent_meshes::MeshStore;
use congruent_robot::{LinkIndex, Robot};

use crate::{
    description::Places,
    mjcf::{self, MjcfInputs},
    urdf::{self, Repairs, URDF_BYTES, UrdfInputs, UrdfPlaces},
};

/// A robot as its URDF or MJCF describes it.
pub(crate) struct ModelFile {
    pub(crate) robot: Robot,
    pub(crate) warnings: Vec<Diagnostic>,
    /// Pairs of links whose contacts the file excludes, the smaller index first; a URDF excludes none.
    pub(crate) excluded: BTreeSet<(LinkIndex, LinkIndex)>,
    /// The places of the URDF or the MJCF.
    pub(crate) places: Places,
}

impl ModelFile {
    /// Reads a file that was opened, with the meshes and files that it names; `declared` are folders of packages by name.
    pub(crate) fn load(
        source: &Arc<SourceFile>,
        declared: BTreeMap<String, PathBuf>,
        access: &FileAccess,
        repairs: &Repairs,
    ) -> Result<Self, Findings> {
        let (path, folder) = (&source.path, folder_of(&source.path));
        let is_mjcf = mjcf::is_mjcf(&source.text);
        // Files that it includes are its text, of which messages show lines: its project decides of which of them.
        let inside = if is_mjcf { access.inside_project_of(path)? } else { access.clone() };
        let mut packages = Packages::new(folder, declared, &inside).map_err(|error| {
            let message = format!("{}: its folder cannot be read: {error}", path.display());
            Diagnostic::error(congruent_input::codes::file::UNREADABLE, message)
        })?;
        // One store for the whole robot: a mesh that several links use is read and checked once.
        let mut meshes = MeshStore::new(&mut packages, &inside);
        let mut find_mesh = |uri: &str, scale| meshes.find(uri, scale);
        if !is_mjcf {
            return Self::from_urdf(source, UrdfInputs { find_mesh: &mut find_mesh, repairs });
        }
        let mut include = |name: &str| inside.read_text(&folder.join(name), URDF_BYTES, TextKind::Robot);
        let inputs = MjcfInputs { include: &mut include, find_mesh: &mut find_mesh };
        Self::from_mjcf(source, inputs, repairs)
    }

    /// The same from the text alone: nothing is opened.
    pub(crate) fn parse(source: &Arc<SourceFile>, repairs: &Repairs) -> Result<Self, Findings> {
        if !mjcf::is_mjcf(&source.text) {
            return Self::from_urdf(source, UrdfInputs { find_mesh: &mut urdf::no_mesh, repairs });
        }
        let mut include = |name: &str| {
            let message =
                format!("\"{name}\" cannot be opened: the MJCF was given as text, without a folder");
            Err(Diagnostic::error(congruent_mjcf::codes::mjcf::INCLUDE, message))
        };
        let inputs = MjcfInputs { include: &mut include, find_mesh: &mut urdf::no_mesh };
        Self::from_mjcf(source, inputs, repairs)
    }

    fn from_urdf(source: &Arc<SourceFile>, inputs: UrdfInputs<'_, '_>) -> Result<Self, Findings> {
        let mut diagnostics = Diagnostics::default();
        let robot = urdf::parse(&source.text, inputs, &mut diagnostics);
        let diagnostics = diagnostics.in_file(source);
        let Some(robot) = robot else { return Err(diagnostics.into()) };
        // Sizes are warned of part by part; which links are large, and so explain their sizes, is known only now.
        let warnings = urdf::without_large_links(&robot, diagnostics);
        let places = Places { urdf: Some(UrdfPlaces::new(Arc::clone(source))), ..Places::default() };
        Ok(Self { robot, warnings, excluded: BTreeSet::new(), places })
    }

    fn from_mjcf(
        source: &Arc<SourceFile>,
        mut inputs: MjcfInputs<'_, '_, '_>,
        repairs: &Repairs,
    ) -> Result<Self, Findings> {
        let mut diagnostics = Diagnostics::default();
        let read = mjcf::parse(source, &mut inputs, &mut diagnostics).map(|mut read| {
            urdf::repair_inertias(&mut read.robot, repairs, &mut diagnostics);
            read
        });
        let is_refused = diagnostics.has_error();
        let warnings = diagnostics.in_file(source);
        match read {
            Some(read) if !is_refused => {
                let places = Places { mjcf: Some(read.places), ..Places::default() };
                Ok(Self { robot: read.robot, warnings, excluded: read.excluded, places })
            }
            _ => Err(warnings.into()),
        }
    }
}
