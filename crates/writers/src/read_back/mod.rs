//! The proof of a text: it is read again, and the robot in it is compared with the one that was written.

mod matched;
mod poses;
mod report;
mod values;

use std::{path::Path, sync::Arc};

use congruent_description::{LinkIndex, RobotDescription, load_opened_robot};
use congruent_input::{Diagnostic, FileAccess, Findings, SourceFile};
use congruent_kinematics::Proof;

use self::{matched::Matched, values::Differences};
use crate::{codes, mjcf::excluded_bodies, robot_text::RobotText};

pub use report::ReadBackReport;

/// How a text is read back.
#[derive(Debug, Clone, Copy)]
pub struct ReadBack<'a> {
    /// The path that the file will have; it need not exist, its folder must.
    pub path: &'a Path,
    /// Which files may be opened: the meshes are.
    pub access: &'a FileAccess,
    /// Largest difference: relative, and of poses in rad and of the size of the robot, at least a metre.
    pub limit: f64,
    /// Seed of the random configurations.
    pub seed: u64,
}

/// Reads a text with the project's own readers, meshes relative to its path, and compares the robot in it with the written one:
/// poses of all links at seeded configurations, screws, inertias, limits, losses, couplings, shapes, excluded pairs.
///
/// # Errors
/// The text cannot be read, or something differs by more than the limit.
pub fn read_back(written: &RobotText, how: ReadBack<'_>) -> Result<(ReadBackReport, Proof), Findings> {
    let (path, text) = (how.path.to_owned(), written.text.clone());
    let source = Arc::new(SourceFile { path, text, is_foreign: false });
    let found = load_opened_robot(&source, how.access)?;
    let matched = Matched::new(&written.robot, &found.robot)?;
    let (proof, reach_m) = poses::compare(&matched, how.seed);
    let mut differences = Differences::default();
    differences.compare_all(&matched);
    compare_excluded(written, &found)?;
    let scale_m = reach_m.max(1.0);
    differences.note("poses", proof.position_m.max(proof.home_m).max(proof.screw_m) / scale_m, || {
        "a link".to_owned()
    });
    differences.note("poses", proof.orientation_rad.max(proof.home_rad).max(proof.screw_rad), || {
        "a link".to_owned()
    });
    if let Some(fault) = differences.beyond(how.limit) {
        return Err(fault.into());
    }
    Ok((ReadBackReport::new(&written.robot, &differences, &proof, how.limit), proof))
}

fn compare_excluded(written: &RobotText, found: &RobotDescription) -> Result<(), Diagnostic> {
    let name = |link: LinkIndex| found.robot.link(link).name.as_str();
    let sorted = |[one, other]: [&str; 2]| {
        if one <= other { [one.to_owned(), other.to_owned()] } else { [other.to_owned(), one.to_owned()] }
    };
    let mut found: Vec<_> =
        found.disabled_collisions.iter().map(|&(one, other)| sorted([name(one), name(other)])).collect();
    let mut expected: Vec<_> =
        excluded_bodies(&written.robot, &written.excluded).into_iter().map(sorted).collect();
    found.sort();
    expected.sort();
    if found == expected {
        return Ok(());
    }
    let message = format!(
        "the written text excludes {} pairs of links from contacts when it is read again, instead of {}",
        found.len(),
        expected.len()
    );
    Err(Diagnostic::error(codes::write::READ_BACK, message))
}
