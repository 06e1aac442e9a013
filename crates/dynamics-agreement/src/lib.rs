//! Do two descriptions of one robot have the same dynamics, and if not, why?
//!
//! The kinematics of both must be the same, which another crate checks. Here masses, centres of mass, inertias, joint
//! terms, gravity and limits are compared: by their effect on joint torques, and link by link.
//!
//! | question | call |
//! |---|---|
//! | what are the dynamics of a description | [`DynamicsModel::new`] |
//! | do two descriptions agree, and why not | [`compare`] |
//! | does a source of accelerations agree | [`compare_with_source`] |
//! | how large can the torque differences become | [`certify`] |
//!
//! Nothing here reads a file or a clock; random numbers come from a caller's seed. The physics engine is not known here: it
//! is an [`AccelerationSource`].

mod bound;
mod compare;
mod diagnosis;
mod differences;
mod model;
mod report;
mod thresholds;
mod torque;

pub use bound::{CoveredMotion, TorqueBracket, TorqueCertificate};
pub use compare::{CompareError, NamedModel, certify, compare, compare_with_source};
pub use diagnosis::{DynamicsCause, EquivalenceReason, FaultySide};
pub use differences::{CandidateAndReference, Invariants, LimitCause, LimitDifference, ParameterDifference};
pub use model::{BodyLaw, DynamicsModel, Frames, Inertial, one_sided_armature::without_one_sided_armature};
pub use report::{
    ComparedModels, DynamicsExplanation, DynamicsPremise, DynamicsReport, DynamicsVerdict, PHYSICS,
    PlacedCause, TorqueCertificates,
};
pub use torque::{AccelerationSource, IdentifiableParameters, IdentificationOptions};
