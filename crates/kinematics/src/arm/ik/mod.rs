//! Inverse kinematics by iteration: which configuration brings the tool to a pose? "Did not
//! converge" is a result, with its residual. How one step is computed is `step.rs`; what is measured
//! is `residual.rs`.

mod nearest;
mod options;
mod residual;
mod result;
mod solver;
mod step;

pub use options::{DifferentialMethod, IkMethod, IkOptions};
pub use residual::{IkTarget, TargetPart};
pub use result::{IkChange, IkResult};
pub use solver::IkSolver;
