//! How large the difference of torque can get over the whole range of the joints' motion: by gravity, by acceleration,
//! by velocity products, and by all of them together.

mod bracket;
mod coupling;
mod dependence;
mod function;
mod gravity;
mod motion;
mod rows;
mod ways;

pub use bracket::{CoveredMotion, TorqueBracket, TorqueCertificate};
pub(crate) use motion::certify;
