//! Do two descriptions of one robot have the same dynamics, and if not, why?
//!
//! The kinematics of both must be the same: that is the question of another crate. Here masses, centres of mass,
//! inertias, joint terms, gravity and limits are compared, by what joint torques tell of them and link by link.
//!
//! | question | call |
//! |---|---|
//! | what does a description say | [`Side::new`] |
//! | do two descriptions agree, and why not | [`compare`] |
//!
//! Nothing here reads a file, a clock or a random number but from a caller's seed.

mod compare;
mod diagnosis;
mod report;
mod side;
mod thresholds;
mod torque;

pub use compare::{Compared, FigureDifference, Invariants, LimitCause, LimitDifference};
pub use diagnosis::{Cause, Place, Reason, Suspect};
pub use report::{
    CompareError, Description, DynamicsReport, Explanation, Name, Premise, Sides, Verdict, compare,
};
pub use side::{BodyLaw, Frames, Inertial, Side};
pub use thresholds::Precision;
pub use torque::{SeenNumbers, State, random_states};
