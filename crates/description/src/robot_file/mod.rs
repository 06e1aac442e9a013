//! The robot file `robot.toml`: which URDF, which chain, which analytical model.

mod check;
mod dh_text;
mod digits;
mod edits;
mod inertials;
mod limits;
mod places;
mod rows;
mod unit_mistakes;
mod written;
mod written_lint;

pub(crate) use check::{Declared, check};
pub use dh_text::dh_text;
pub use digits::TableDigits;
pub use inertials::{DeclaredInertial, DynamicsTable, InertialFrame, InertialPlaces, InertialPoint};
pub use places::{ConstantKey, ConstantPart, RobotFilePlaces, RowKey, ValuePlace};
pub use written::{WrittenRobot, robot_file_schema};
pub use written_lint::{WrittenIgnore, WrittenLint};

/// Size limit of a robot file, bytes.
pub(crate) const ROBOT_FILE_BYTES: u64 = 1 << 20;

/// The name that a robot file has in a robot's folder.
pub(crate) const ROBOT_FILE: &str = "robot.toml";
