//! Loads a robot with values that replace those of its files.

use std::{path::Path, sync::Arc};

use congruent_input::{
    Diagnostic, FileAccess, Findings, Override, SourceFile, distinct_places, toml_text::parse_document,
};
use congruent_robot::Robot;

use crate::{
    description::RobotDescription,
    load::{load_opened_robot, load_robot_with},
    named_robot::{file_of_robot, is_toml, open},
    robot_file::ROBOT_FILE_BYTES,
};

/// Loads a robot with other values than its files have.
///
/// A key is one of the robot file (`dh.row.elbow_joint.d_m`, `tcp.xyz_m.3`), or a value of a link or joint (`link.NAME.mass_kg`),
/// whichever file it comes from: [`Robot::with_value`](congruent_robot::Robot::with_value) lists these. Values of the robot file are
/// replaced in its text, so that digits and messages are those of the values.
///
/// # Errors
/// As [`load_robot_with`], or a key that the file does not have, a name that the robot does not have, or a value of another kind.
///
/// # Examples
/// ```
/// use congruent_description::load_robot_set;
/// let robot = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e");
/// let heavier = ["link.forearm_link.mass_kg=3.0".parse()?];
/// let loaded = load_robot_set(robot.as_ref(), &heavier, &Default::default())?;
/// let link = loaded.robot.find_link("forearm_link").unwrap();
/// assert_eq!(loaded.robot.link(link).inertia.as_ref().unwrap().mass_kg, 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load_robot_set(
    path: &Path,
    overrides: &[Override],
    access: &FileAccess,
) -> Result<RobotDescription, Findings> {
    let (of_model, of_file): (Vec<&Override>, Vec<&Override>) =
        overrides.iter().partition(|change| Robot::has_value(change));
    let description = match of_file.first() {
        None => load_robot_with(path, access)?,
        Some(first) => {
            let path = file_of_robot(path)?;
            if !is_toml(&path) {
                let why = format!("{} is no robot file (robot.toml), which has such keys", path.display());
                return Err(first.refused(&why).into());
            }
            let source = open(&path, access, ROBOT_FILE_BYTES)?;
            distinct_places(of_file.iter().copied(), &parse_document(&source.text)?)?;
            let text =
                of_file.iter().try_fold(source.text.clone(), |text, change| change.edit_text(&text))?;
            let edited = SourceFile { text, path: source.path.clone(), is_foreign: source.is_foreign };
            load_opened_robot(&Arc::new(edited), access)?
        }
    };
    let set_values = overrides.iter().map(ToString::to_string).collect();
    Ok(RobotDescription { set_values, ..description.with_model_values(&of_model)? })
}

impl RobotDescription {
    /// The same robot with other values of links and joints.
    ///
    /// # Errors
    /// As [`Robot::with_value`](congruent_robot::Robot::with_value), or two are of one value.
    pub fn with_model_values(mut self, changes: &[&Override]) -> Result<Self, Diagnostic> {
        Robot::refuse_repeated(changes)?;
        for change in changes {
            self.robot = self.robot.with_value(change)?;
        }
        Ok(self)
    }
}
