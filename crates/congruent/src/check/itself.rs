//! A robot against its own file: there is one description, and nothing to compare it with.

use std::path::Path;

use congruent_agreement::compare::{CheckReport, ComparedSource, NotCompared};
use congruent_description::RobotDescription;
use congruent_input::Diagnostic;

use crate::codes;

/// Whether the other description is the robot's own file, or the URDF or MJCF that its robot file names.
pub(super) fn is_itself(description: &RobotDescription, other: &RobotDescription) -> bool {
    let is_bare = other.path == other.urdf_path;
    // With values that were set the file is another description.
    let is_as_written = description.set_values.is_empty();
    let is_own_file = is_as_written && is_same_file(&description.path, &other.path);
    has_one_file([description, other]) && (is_bare || is_own_file)
}

/// Whether two descriptions have their links and masses from one file.
pub(super) fn has_one_file([description, other]: [&RobotDescription; 2]) -> bool {
    let are_files = !description.is_loaded() && !other.is_loaded();
    are_files && is_same_file(&description.urdf_path, &other.urdf_path)
}

/// By the place on the disk: a file of a revision or of standard input has none.
fn is_same_file(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}

/// That `--against` gives no second description, in place of the advice to use it.
pub(super) fn add_itself(geometry: &mut CheckReport, other: &RobotDescription) {
    let file = other.path.display();
    let why =
        format!("--against names {file}, the robot's own file: name another file, or a revision: git:HEAD~1");
    let finding = || Diagnostic::warning(codes::check::NO_SECOND_SOURCE, why.clone());
    let is_missing = |of: &NotCompared| {
        let of_one = of.findings.iter().any(|of| of.code == codes::check::NO_SECOND_SOURCE.name);
        of_one && [ComparedSource::Geometry, ComparedSource::Dynamics].contains(&of.source)
    };
    for of in geometry.not_asked.iter_mut().filter(|of| is_missing(of)) {
        *of = NotCompared::because(of.source, &finding());
    }
}
