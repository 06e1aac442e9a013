//! Do two kinematic models describe the same robot, and if not, why?
//!
//! The candidate (`candidate.rs`) is a table, or screws that were identified; the reference model
//! (`reference_model.rs`) is a chain of joints. Both are compared as screws and tip at one generic
//! configuration (`fit/evaluation_point.rs`), which is exact, by their invariants (`invariants.rs`), and by
//! fitting each hypothesis of a catalogue (`cause/`, `fit/`) to the difference. The
//! explanations are ranked (`score.rs`), and those that no measurement can distinguish are listed with the
//! reason (`equivalence.rs`). Two URDFs are compared joint by joint before that (`explained_by_joints` of `mapping`). Every threshold is in
//! `thresholds.rs`. The bound of the difference is in [`crate::bound`].

mod candidate;
mod cause;
mod digits;
mod dropped_joint;
mod equivalence;
mod explanation;
mod fewest_changes;
mod fit;
mod fitted_length;
mod from_description;
mod hypothesis;
mod invariants;
mod nearest_table;
mod origin_reading;
mod reference_model;
mod score;
mod search;
pub(crate) mod thresholds;

pub use candidate::{CandidateModel, CandidateRow, DeclaredTransform, DhEntry, ModelParameter, RowConstants};
pub(crate) use digits::tie_written_alike;
pub use digits::{TransformPart, TypedPlace, TypedValue, WrittenDigits};
pub(crate) use dropped_joint::with_dropped_joints;
pub use equivalence::Equivalence;
pub use explanation::{Criterion, ExplainedFault, Explanation};
pub use hypothesis::{Cause, FaultPlace, ModelPair, RowShift};
pub(crate) use invariants::compare as differences;
pub use invariants::{Invariant, JointDifference};
pub(crate) use nearest_table::nearest_table;
pub use reference_model::{ReferenceJoint, ReferenceModel};
pub use search::{Diagnosis, diagnose};
