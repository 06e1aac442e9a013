//! Diagnosis of the twin from the samples of a run alone: which joint, which kind of fault, its size and its beginning. The
//! faults that a scenario injects are not used.
//!
//! The positions of the joints follow from the poses of the twin's links (`observed`), and `noise` estimates how far readings
//! may be from them. The errors of the encoders, and the reported effort minus the effort that the motion needs (`residual`),
//! are fitted by a catalogue of hypotheses, one file for each family; `shape`, `extent` and `fit` decide between them and when a
//! fault begins and ends.

mod actuator;
mod diagnose;
mod encoder;
mod extent;
mod fit;
mod judgement;
mod noise;
mod observed;
mod payload;
mod residual;
mod shape;
mod stuck;
mod tool;
mod transport;

pub use diagnose::{DiagnosedRun, FoundFault, RunDiagnosis, diagnose};
pub use judgement::{FaultVerdict, judge};
