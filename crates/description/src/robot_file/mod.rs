//! The robot file `robot.toml`: which URDF, which chain, which analytical model.

mod check;
mod edits;
mod inertials;
mod limits;
mod places;
mod rows;
mod unit_slips;
mod write;
mod written;

pub(crate) use check::{Declared, check};
pub use inertials::{DeclaredDynamics, DeclaredInertial, InertialFrame, InertialPlaces, InertialPoint};
pub use places::{ConstantKey, ConstantPart, RobotFilePlaces, RowKey, ValuePlace};
pub use write::{dh_section, relative_path, robot_file_text, robot_file_values, toml_key, toml_string};
pub(crate) use written::WrittenRobot;
pub use written::robot_file_schema;

/// The largest robot file that is read.
pub(crate) const ROBOT_FILE_BYTES: u64 = 1 << 20;

/// The name that a robot file has in a robot's folder.
pub(crate) const ROBOT_FILE: &str = "robot.toml";
