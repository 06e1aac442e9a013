//! The report of a comparison: its values, their places in files, and its sentences.

pub(crate) mod content;
pub(crate) mod explained;
mod limit_sentence;
mod parameter_sentence;
pub(crate) mod places;
mod sentences;

pub use content::{
    ComparedModels, DynamicsExplanation, DynamicsPremise, DynamicsReport, DynamicsVerdict, PHYSICS,
    PlacedCause, TorqueCertificates,
};
