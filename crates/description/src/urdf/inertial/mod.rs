//! `<inertial>`: which inertias a body can have, the nearest possible one, and the bodies that need one.

mod bodies;
mod possible;
mod repair;

pub(super) use bodies::judge;
pub(crate) use bodies::repair_inertias;
pub(crate) use repair::Repairs;

#[cfg(test)]
mod tests;
pub use possible::LARGEST_GYRATION_M;
pub use repair::nearest_possible_tensor;
