//! Calibration: small corrections to a chain, from measured poses or points of its tip.
//!
//! Every correction is a twist that is inserted between two joints of a [`ScrewChain`], so that
//! zero offsets, table entries, axes, base and tool are one kind of thing: exact, minimal in its
//! own slot, and continuous even if a table's entries are not (parallel axes). [`align`] puts base and tool where the
//! measurements are, [`identify`] decides which
//! of them the measurements identify, [`fit`] estimates those by least squares, [`fit_robustly`]
//! with a loss that is robust to gross errors, [`held_out`] cross-validates, and [`most_informative`] suggests
//! the next measurements. Nothing here draws a random number: candidates are passed in.

mod align;
mod estimate;
mod identify;
mod model;
mod plan;
mod problem;
mod profile;
mod robust;
mod validate;

pub use align::align;
pub use estimate::{CalibrationFit, fit, fit_with_estimated_noise};
pub use identify::{FixedParameter, Identification, identify};
pub(crate) use identify::{MeasuredInformation, identify_by_information};
pub(crate) use model::Displacements;
pub use model::{
    CorrectedChain, CorrectionEntry, CorrectionParameter, ParameterUnit, base_pose, dh_entries, joint_axes,
    tool_pose, zero_offsets,
};
pub use plan::{Suggestion, most_informative};
pub use problem::{Measurement, Noise, PoseResidual, Problem, configurations};
pub use profile::{CostPoint, cost_curve};
pub use robust::{Loss, RobustFit, fit_robustly};
pub use validate::{FEWEST_CONFIGURATIONS, FOLDS_UNSETTLED, FoldOptions, HeldOut, MOST_FOLDS, held_out};

#[cfg(doc)]
use congruent_kinematics::ScrewChain;
