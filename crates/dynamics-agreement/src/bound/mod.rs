//! How large the difference of gravity torque can get over the whole range of the joints.

mod branch;
mod climb;
mod gravity;
mod trigonometric;

pub(crate) use gravity::certify;
pub use gravity::{TorqueBracket, TorqueCertificate};
