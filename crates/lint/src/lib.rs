//! What is suspicious in files that can be read, as `lint` reports it; findings that a robot file ignores; and corrections
//! that do not change the meaning of a file. What a reader refuses is reported by the reader; crate `congruent` joins both.

mod coarse_turns;
pub mod codes;
mod encoding;
mod fix;
mod fix_misspelt_keys;
mod ignore;
mod kind;
mod limits;
mod materials;
mod mimics;
mod references;
mod srdf;
mod srdf_elements;
mod srdf_groups;
mod unit_mistakes;

pub use coarse_turns::coarse_quarter_turns;
pub use encoding::declared_encoding;
pub use fix::{SafeFix, safe_fixes};
pub use fix_misspelt_keys::safe_robot_file_fixes;
pub use ignore::{IgnoredFinding, Ignores};
pub use kind::{FileKind, FileToLint};
pub use limits::zero_limits;
pub use materials::undefined_materials;
pub use mimics::still_mimics;
pub use references::unknown_references;
pub use srdf::{examine_srdf, robot_name};
pub use unit_mistakes::unit_mistakes;
