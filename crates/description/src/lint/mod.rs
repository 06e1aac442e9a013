//! What is wrong or suspicious in files, as `lint` tells it: findings that are ignored by a robot file, and corrections
//! that change nothing of what a file means.

mod fix;
mod ignore;
mod kind;
mod slips;

pub use fix::{SafeFix, safe_fixes};
pub(crate) use ignore::WrittenLint;
pub use ignore::{IgnoredFinding, Ignores};
pub use kind::FileKind;
pub use slips::unit_slips;
