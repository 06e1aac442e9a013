//! Why two sides have other torques.
//!
//! [`diagnose_in_stages`] tries the hypotheses of `cause/` (one file a family) on the compressed difference of torque (`fit.rs`,
//! `search.rs`), orders those that leave nothing by what they cost (`rank.rs`), and says of the others why torque cannot
//! tell them from the first (`reason.rs`).

mod cause;
mod cause_names;
mod diagnose;
mod fit;
mod free;
mod hypothesis;
mod part_by_part;
mod rank;
mod reason;
mod search;

pub(crate) use cause::{rounded_damping_unit, rounded_unit};
pub use cause_names::DynamicsCause;
pub(crate) use diagnose::{Expected, Grouped, Setting, diagnose_in_stages};
pub(crate) use fit::Corrected;
pub use hypothesis::FaultySide;
pub(crate) use hypothesis::{Hypothesis, Place};
pub(crate) use part_by_part::part_by_part;
pub(crate) use rank::Exact;
pub use reason::EquivalenceReason;

#[cfg(test)]
mod planted;
