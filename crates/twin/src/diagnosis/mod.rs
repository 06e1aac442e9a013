//! What is wrong with the twin, from the samples of a run alone: which joint, which kind of fault, how large, from when on.
//! The faults that a scenario injects are not looked at.
//!
//! The poses of the twin's links show where its joints are (`observed`), and `noise` how far readings may be from that. What
//! encoders read instead, and the effort that the drives report against the one that the motion needs (`residual`), are
//! fitted by a catalogue of hypotheses, one file a family; `shape` and `fit` decide between them.

mod actuator;
mod diagnose;
mod encoder;
mod fit;
mod noise;
mod observed;
mod payload;
mod residual;
mod shape;
mod store;
mod stuck;
mod tool;
mod transport;

pub(crate) use diagnose::diagnose;
pub use diagnose::{FoundFault, RunDiagnosis};
pub(crate) use store::SampleStore;
