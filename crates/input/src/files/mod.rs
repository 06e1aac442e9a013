//! Which files are opened, how, and which were: nothing else in this crate opens one.

mod access;
mod open;
mod packages;
mod project;
mod ros_packages;
mod text_lines;

pub use access::{FileAccess, InputFile, OUTSIDE};
pub use open::{NOT_FOUND, folder_of, head_of, is_standard_input, not_found, read_text};
pub use packages::{MESH_OUTSIDE, Packages, Resolved};
pub use ros_packages::RosPackages;
pub use text_lines::TextLines;
