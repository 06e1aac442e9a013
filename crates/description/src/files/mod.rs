//! Which files are opened, how, and which were: nothing else in this crate opens one.

mod access;
mod open;
mod packages;
mod project;
mod ros_packages;
mod text_stream;

pub use access::{FileAccess, InputFile};
pub(crate) use open::{folder_of, head_of, not_found};
pub use open::{is_standard_input, read_text};
pub(crate) use packages::{Packages, Resolved};
pub use ros_packages::RosPackages;
pub(crate) use text_stream::TextStream;
