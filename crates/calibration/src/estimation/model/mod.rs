//! The model that is fitted: a chain with correction parameters between its joints.

mod corrected_chain;
mod correction_parameter;
mod displacements;
mod parameter_set;

pub(super) use corrected_chain::ChainAt;
pub use corrected_chain::CorrectedChain;
pub use correction_parameter::{CorrectionEntry, CorrectionParameter, ParameterUnit};
pub(crate) use displacements::Displacements;
pub use parameter_set::{base_pose, dh_entries, joint_axes, tool_pose, zero_offsets};
