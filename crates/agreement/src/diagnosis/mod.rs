//! Do two kinematic models describe the same robot, and if not, why? One rung of the answer in each
//! file: probe, invariants, gauge, cause, certificate.
//!
//! The suspect is a table or anything that can be probed; the reference is a chain of joints. Both
//! are compared as screws and tip at one generic configuration, which is exact, and a catalogue of
//! hypotheses is tried on the difference. How far the two are apart at most is the certificate's.

mod cause;
mod described;
mod diagnosis;
mod gauge;
mod hypothesis;
mod invariants;
mod reference;
mod refit;
mod score;
mod search;
mod snapshot;
mod suspect;
mod trial;

pub use diagnosis::{Diagnosis, Explanation, Part, Question, Residual};
pub use gauge::Gauge;
pub use hypothesis::{Case, Cause, Place};
pub use invariants::{Invariant, JointDifference};
pub use reference::{Reference, ReferenceJoint};
pub use search::diagnose;
pub use suspect::{Constant, Entry, Parameter, Suspect, SuspectLink, SuspectRow};
