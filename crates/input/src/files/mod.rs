//! Which files are opened, how, and which were: nothing else in this crate opens one.

mod access;
mod kind;
mod open;
mod packages;
mod portable;
mod project;
mod pseudo;
mod relative_path;
mod revision;
mod ros_packages;
mod text_lines;

pub use access::{FileAccess, InputFile};
pub use kind::{TextKind, TomlKind};
pub use open::{
    absence, folder_of, head_of, is_standard_input, not_found, open_regular, read_text, unreadable,
};
pub use packages::{Packages, Resolved};
pub use portable::{portable_path, portable_text};
pub use relative_path::{direct_path, relative_path};
pub use revision::{RevisionFiles, RevisionName};
pub use ros_packages::RosPackages;
pub use text_lines::TextLines;
