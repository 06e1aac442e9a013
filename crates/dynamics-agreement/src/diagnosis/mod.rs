//! Why two models have different torques.
//!
//! [`diagnose_in_stages`] fits the hypotheses of `cause/` (one file for each family) to the reduced torque difference (`fit.rs`,
//! `search.rs`), orders those with a residual within tolerance by complexity (`rank.rs`), and says why joint torques cannot
//! distinguish the others from the first (`reason.rs`).

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
mod term_by_term;

pub(crate) use cause::{rounded_damping_unit, rounded_unit};
pub use cause_names::DynamicsCause;
pub(crate) use cause_names::MISSING_THERE;
pub(crate) use diagnose::{DiagnosisInput, ExplanationGroup, ReferenceTorques, diagnose_in_stages};
pub(crate) use fit::Corrected;
pub use hypothesis::FaultySide;
pub(crate) use hypothesis::{DynamicsHypothesis, DynamicsPlace};
pub(crate) use part_by_part::part_by_part;
pub(crate) use rank::{ExactExplanation, is_same_body};
pub use reason::EquivalenceReason;
pub(crate) use term_by_term::term_by_term;

#[cfg(test)]
mod planted;
