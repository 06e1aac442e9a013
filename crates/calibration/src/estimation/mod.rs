//! Calibration: small corrections to a chain, from measured poses or points of its tip.
//!
//! Every correction is a twist that is inserted between two joints of a [`ScrewChain`], so that
//! zero offsets, table entries, axes, base and tool are one kind of thing: exact, minimal in its
//! own slot, and continuous where a table's entries are not (parallel axes). [`identify`] says which
//! of them the measurements tell apart, [`fit`] estimates those by least squares, [`fit_robustly`]
//! with a loss that gross errors cannot bend, [`held_out`] on measurements that the estimate has not
//! seen, and [`most_telling`] says where to measure next. Nothing here draws a random number:
//! candidates are passed in.

mod configurations;
mod estimate;
mod identify;
mod model;
mod noise;
mod parameter;
mod parameter_set;
mod plan;
mod profile;
mod residuals;
mod robust;
mod validate;

pub use configurations::configurations;
pub use estimate::{Fit, fit, fit_with_estimated_noise};
pub use identify::{FixedParameter, Identification, identify};
pub use model::CorrectedChain;
pub use noise::Noise;
pub use parameter::{Entry, Parameter, ParameterUnit};
pub use parameter_set::{base_pose, dh_entries, joint_axes, tool_pose, zero_offsets};
pub use plan::{Suggestion, most_telling};
pub use profile::{CostPoint, cost_curve};
pub use residuals::{Measurement, Problem, Residual};
pub use robust::{Loss, RobustFit, fit_robustly};
pub use validate::{HeldOut, held_out};

#[cfg(doc)]
use congruent_kinematics::ScrewChain;
