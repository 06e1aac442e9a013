//! How large the difference of torque can get over the whole range of the joints: by gravity, and by acceleration.

mod branch;
mod climb;
mod gravity;
mod inertia;
mod trigonometric;
mod ways;

pub(crate) use gravity::certify as certify_gravity;
pub use gravity::{TorqueBracket, TorqueCertificate};
pub(crate) use inertia::certify as certify_inertia;
