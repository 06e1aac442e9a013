//! Do two kinematic models describe the same robot, and if not, why? One rung of the answer in each
//! file: probe, invariants, equivalence, cause, certificate.
//!
//! The candidate is a table or anything that can be identified; the reference is a chain of joints. Both
//! are compared as screws and tip at one generic configuration, which is exact, and a catalogue of
//! hypotheses is tried on the difference. How far the two are apart at most is the certificate's.

mod candidate;
mod cause;
mod described;
mod equivalence;
mod evaluation_point;
mod explanation;
mod hypothesis;
mod hypothesis_fit;
mod invariants;
mod least_squares;
mod reference_model;
mod score;
mod search;

pub use candidate::{Candidate, CandidateRow, Constant, DhEntry, ModelParameter, RowConstants};
pub use equivalence::Equivalence;
pub use explanation::{Criterion, Explanation, Part};
pub use hypothesis::{Cause, ModelPair, Place};
pub use invariants::{Invariant, JointDifference};
pub use reference_model::{ReferenceJoint, ReferenceModel};
pub use search::{Diagnosis, diagnose};
