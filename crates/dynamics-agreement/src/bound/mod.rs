//! How large the difference of torque can get over the whole range of the joints' motion: by gravity, by acceleration,
//! by velocity products, and by all of them together.

mod bracket;
mod branch;
mod climb;
mod coupling;
mod dependence;
mod gravity;
mod measure;
mod motion;
mod rows;
mod speeds;
mod trigonometric;
mod ways;

pub use bracket::{CoveredMotion, TorqueBracket, TorqueCertificate};
pub(crate) use motion::certify;
