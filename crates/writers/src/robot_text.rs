//! A robot as text in one of the formats.

use std::{collections::BTreeSet, path::Path};

use congruent_description::{LinkIndex, Robot, RobotDescription};
use congruent_input::{Diagnostic, Diagnostics};

use crate::{fit, format::RobotFormat, mjcf, urdf};

/// A robot as text, and the robot that the text must give when it is read.
#[derive(Debug, Clone)]
pub struct RobotText {
    /// The whole file.
    pub text: String,
    /// The robot that the text describes: the source, except for what `warnings` report.
    pub robot: Robot,
    /// Pairs of links whose contacts the text excludes, the smaller index first.
    pub excluded: BTreeSet<(LinkIndex, LinkIndex)>,
    /// What the format cannot hold, and what was written for it.
    pub warnings: Vec<Diagnostic>,
}

/// Writes the whole robot of a description for a file in `folder` (absolute, without links), to which paths of meshes are relative.
///
/// # Errors
/// The format cannot hold the robot at all; the message has the reason.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use congruent_description::parse_robot;
/// use congruent_input::SourceFile;
/// use congruent_writers::{RobotFormat, robot_text};
/// let urdf = "<robot name='stand'><link name='base'/></robot>".into();
/// let source = SourceFile { path: "stand.urdf".into(), text: urdf, is_foreign: false }.into();
/// let stand = parse_robot(None, &source).unwrap();
/// let written = robot_text(&stand, RobotFormat::Mjcf, Path::new("/")).unwrap();
/// assert!(written.text.contains("<body name=\"base\""));
/// ```
pub fn robot_text(
    description: &RobotDescription,
    format: RobotFormat,
    folder: &Path,
) -> Result<RobotText, Diagnostic> {
    let mut diagnostics = Diagnostics::default();
    let robot = fit::fitted(description, format, &mut diagnostics)?;
    let (text, excluded) = match format {
        RobotFormat::Urdf => (urdf::urdf_text(&robot, folder), BTreeSet::new()),
        RobotFormat::Mjcf => {
            let excluded = &description.disabled_collisions;
            (mjcf::mjcf_text(&robot, excluded, folder), excluded.clone())
        }
    };
    Ok(RobotText { text, robot, excluded, warnings: diagnostics.into_vec() })
}
