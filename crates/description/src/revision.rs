//! A robot as a revision in git has it: `git:REV:PATH`.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Diagnostic, FileAccess, Findings, InputFile, RevisionFiles, SourceFile};

use crate::{RobotDescription, mjcf::MjcfPlaces};

/// What was loaded from the files of a revision, with paths that a person can give again: `git:main:robots/arm.urdf`. The files that
/// were read are added to those of `access`.
pub(crate) fn as_named(
    loaded: Result<RobotDescription, Findings>,
    read: Vec<InputFile>,
    files: &RevisionFiles,
    access: &FileAccess,
) -> Result<RobotDescription, Findings> {
    let inputs = read.into_iter().map(|input| named_input(input, files)).collect::<Vec<_>>();
    access.add(&inputs);
    match loaded {
        Ok(description) => Ok(RobotDescription { inputs, ..named(description, files) }),
        Err(faults) => {
            Err(faults.into_iter().map(|fault| named_fault(fault, files)).collect::<Vec<_>>().into())
        }
    }
}

fn named_input(input: InputFile, files: &RevisionFiles) -> InputFile {
    let path = files.named(&input.path);
    let is_named = path != input.path;
    InputFile { file: if is_named { path.display().to_string() } else { input.file }, path, ..input }
}

fn named(mut description: RobotDescription, files: &RevisionFiles) -> RobotDescription {
    let path = |path: &mut PathBuf| *path = files.named(path);
    path(&mut description.path);
    path(&mut description.urdf_path);
    description.references.iter_mut().for_each(|reference| path(&mut reference.path));
    description.named_files.srdf.iter_mut().for_each(path);
    let warnings = std::mem::take(&mut description.warnings);
    description.warnings = warnings.into_iter().map(|warning| named_fault(warning, files)).collect();
    let source = |source: &mut Arc<SourceFile>| *source = named_source(source, files);
    let places = &mut description.places;
    places.robot_file.iter_mut().filter_map(Arc::get_mut).for_each(|places| source(places.source_mut()));
    places.inertials.iter_mut().filter_map(Arc::get_mut).for_each(|places| source(places.source_mut()));
    places.own_model.iter_mut().filter_map(Arc::get_mut).for_each(|places| source(places.source_mut()));
    places.urdf.iter_mut().for_each(|places| source(places.source_mut()));
    places.mjcf.iter_mut().flat_map(MjcfPlaces::files_mut).for_each(source);
    description
}

fn named_fault(fault: Diagnostic, files: &RevisionFiles) -> Diagnostic {
    Diagnostic {
        message: files.named_in(&fault.message),
        help: fault.help.map(|help| files.named_in(&help)),
        source: fault.source.map(|source| named_source(&source, files)),
        ..fault
    }
}

fn named_source(source: &SourceFile, files: &RevisionFiles) -> Arc<SourceFile> {
    let path = files.named(Path::new(&source.path));
    Arc::new(SourceFile { path, text: source.text.clone(), is_foreign: source.is_foreign })
}
