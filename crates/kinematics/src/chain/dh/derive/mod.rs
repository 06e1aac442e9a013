//! From a chain of screws to a table.

mod axis;
mod choice;
mod derivation;
mod normal;
mod rounded;
mod tidy;

pub use axis::DeriveError;
pub use choice::{Choice, FreeChoice};
pub use derivation::{AxisPair, DhDerivation, derive_dh};
pub use normal::AxisRelation;
pub use rounded::{ROUNDED_M, ROUNDED_RAD, RoundedPair, without_rounding};
