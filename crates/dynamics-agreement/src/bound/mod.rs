//! Certified bounds of the torque difference over the whole range of the joints' motion: of gravity, of accelerations, of
//! velocity products, and of all together.

mod bracket;
mod coupling;
mod dependency;
mod function;
mod gravity;
mod motion;
mod rows;
mod variable_group;

pub use bracket::{CoveredMotion, TorqueBracket, TorqueCertificate};
pub(crate) use motion::certify;
