//! Whole robots as text: URDF and MJCF, with inertias, limits, losses, couplings and shapes; and robot files.
//!
//! 1. `fit` makes the robot that the format can hold: what it cannot hold is changed or left out there, each with a warning.
//! 2. `urdf` and `mjcf` write this robot, and lose nothing of it.
//! 3. `read_back` reads the text with the readers of crate `description` and compares what they find with the robot.
//!
//! No file is written here: the caller does that once the text has been read back.

pub mod codes;
mod fit;
mod fit_inertia;
mod format;
mod links;
mod mesh_file;
mod mjcf;
mod read_back;
mod robot_file_text;
mod robot_text;
mod shape;
mod urdf;
mod xml_text;

pub use fit::lost_armature;
pub use format::RobotFormat;
pub use read_back::{ReadBack, ReadBackReport, read_back};
pub use robot_file_text::{
    dh_section, own_dh_section, own_robot_file_text, poe_section, relative_path, robot_file_text,
    robot_file_values,
};
pub use robot_text::{RobotText, robot_text};
pub use urdf::urdf_text;
