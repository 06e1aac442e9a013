//! Friction, armature, masses and torque constants of a robot from what was recorded of it: joint positions and efforts.
//!
//! | step | call |
//! |---|---|
//! | how long the window of the derivatives is | [`SampledParts::survey`] |
//! | rows of a recording to equations, in memory that does not grow | [`Collector`] |
//! | what the efforts are | [`recognise`], in a run [`EffortFit`] |
//! | the parameters, their uncertainty, and whether they are better on data that was left out | [`identify`] |
//! | a motion that shows the parameters | [`excitation`] |
//!
//! Torques are linear in the parameters (`congruent_dynamics::BodyTree::regressor_into`), so that a recording of any length becomes
//! one matrix for each joint and each part of the time.

mod collect;
mod effort_fit;
mod effort_kind;
mod equations;
mod estimate;
pub mod excitation;
mod free_bodies;
mod held_out;
mod identified;
mod indistinct;
mod pseudo_inertia;
mod recording_survey;
mod regressor_row;
pub mod report;
mod smoothing;
mod solve;
mod unknowns;

pub use collect::{Collector, Instants, RecordedRow};
pub use effort_fit::EffortFit;
pub use effort_kind::{EffortKind, RecognisedEffort, recognise};
pub use equations::{JointEquations, RecordedEquations};
pub use estimate::{JointNoise, ParameterEstimate};
pub use held_out::HeldOutEffort;
pub use identified::{
    IdentifiedBody, IdentifiedJoint, IdentifiedParameters, IdentifiedValue, IndistinctTerm, identify,
};
pub use recording_survey::{RecordingSurvey, SampledParts};
pub use smoothing::{SmoothedInstant, Smoothing};
pub use unknowns::{FreeGroup, FreeUnknowns, JointUnknown, PayloadPlace};
