//! Jacobians of the three kinds, and how they change.

pub(crate) mod columns;
mod derivative;
pub(crate) mod kind;

pub use columns::Jacobian;
pub use kind::JacobianKind;
