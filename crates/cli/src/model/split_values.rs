//! Values of `check` that a space has cut in two.

use std::path::PathBuf;

use congruent::input::{Diagnostic, absence, codes::file::NOT_FOUND};

use crate::{quantity::QuantityArgument, tolerance::ToleranceArgument};

/// Refuses the second half of a value that is written with a space, in place of a robot: of a tolerance, or of `git:REV`.
pub(super) fn split_values(
    robots: &[PathBuf],
    against: &[PathBuf],
    tolerance: Option<ToleranceArgument>,
) -> Result<(), Diagnostic> {
    let is_git = |path: &&PathBuf| path.as_os_str() == "git" && !path.exists();
    if let Some(git) = against.iter().find(is_git) {
        let revision = robots.iter().find(|path| !path.exists());
        let revision = revision.map_or_else(|| "REV".into(), |path| path.display().to_string());
        return Err(Diagnostic::error(NOT_FOUND, absence(git))
            .with_help(format!("a colon and no space before the revision: --against git:{revision}")));
    }
    let has_unit = |path: &&PathBuf| {
        let found = path.to_str().and_then(|text| QuantityArgument::parse(text).ok());
        found.is_some_and(|of| of.dimension.is_some()) && !path.exists()
    };
    let misplaced = tolerance.and(robots.iter().find(has_unit));
    misplaced.map_or(Ok(()), |part| {
        Err(Diagnostic::error(NOT_FOUND, absence(part)).with_help(format!(
            "a comma joins both parts of a tolerance, without a space: --tolerance 1mm,{}",
            part.display()
        )))
    })
}
