//! `[dynamics]` and `[[inertial]]`: masses, centres of mass and inertias beside those of the URDF.

mod check;
mod declared;
mod digits;
mod places;
mod written;

pub(super) use check::{InertialContext, check};
pub use declared::{DeclaredInertial, DynamicsTable, InertialFrame, InertialPoint};
pub use digits::InertialDigits;
pub use places::InertialPlaces;
pub(crate) use written::{WrittenDynamics, WrittenInertial};

#[cfg(test)]
mod tests;
