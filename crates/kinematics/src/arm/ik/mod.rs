//! Iterative inverse kinematics: finds a configuration that brings the tool to a pose. "Did not converge" is a result, with its
//! residual. `step.rs` computes one step, `residual.rs` the error.

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
