//! `[source]`: the log of a run, with its joints and poses resolved.

mod joints;
mod poses;
mod recorded_setup;

pub use recorded_setup::RecordedSetup;
