//! What is wrong or suspicious in files, as `lint` tells it: findings that are ignored by a robot file, and corrections
//! that change nothing of what a file means.

mod encoding;
mod fix;
mod fix_keys;
mod ignore;
mod kind;
mod limits;
mod materials;
mod mimics;
mod references;
mod slips;
mod srdf;
mod srdf_elements;
mod srdf_groups;

pub use encoding::declared_encoding;
pub use fix::{SafeFix, safe_fixes};
pub use fix_keys::safe_robot_file_fixes;
pub(crate) use ignore::WrittenLint;
pub use ignore::{IgnoredFinding, Ignores};
pub use kind::{FileKind, FileToLint};
pub use limits::zero_limits;
pub use materials::undefined_materials;
pub use mimics::still_mimics;
pub use references::unknown_references;
pub use slips::unit_slips;
pub use srdf::{examine_srdf, robot_name};
