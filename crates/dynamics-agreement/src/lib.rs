//! Do two descriptions of one robot have the same dynamics, and if not, why?
//!
//! The kinematics of both must be the same: that is the question of another crate. Here masses, centres of mass,
//! inertias, joint terms, gravity and limits are compared, by what joint torques tell of them and link by link.
//!
//! | question | call |
//! |---|---|
//! | what does a description say | [`Side::new`] |
//! | do two descriptions agree, and why not | [`compare`] |
//! | does a source of accelerations agree | [`compare_with_source`] |
//! | how large can the differences of torque get | [`certify`] |
//!
//! Nothing here reads a file, a clock or a random number but from a caller's seed, and the physics engine is unknown: it
//! is an [`AccelerationSource`].

mod bound;
mod compare;
mod diagnosis;
mod report;
mod side;
mod thresholds;
mod torque;

pub use bound::{CoveredMotion, TorqueBracket, TorqueCertificate};
pub use compare::{Compared, Invariants, LimitCause, LimitDifference, ParameterDifference};
pub use diagnosis::{DynamicsCause, EquivalenceReason, FaultySide};
pub use report::{
    CompareError, DynamicsExplanation, DynamicsPremise, DynamicsReport, DynamicsVerdict, NamedSide,
    ParameterPlaces, PlacedCause, Sides, TorqueCertificates, certify, compare, compare_with_source,
};
pub use side::{BodyLaw, Frames, Inertial, Side};
pub use torque::{AccelerationSource, Probing, SeenNumbers};
