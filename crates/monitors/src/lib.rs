//! Checks of a scenario in a run: each is a [`Monitor`] that gets every [`Sample`], and never the physics engine.
//!
//! The folders hold the checks by what they look at, [`RunningCheck`] makes one from its settings, [`verdict`] is what they
//! result in. A sample and what it holds, its names and the [`Recorder`] that gets it as well are here, too.

mod actuator_limits;
mod clock;
pub mod codes;
mod context;
mod delivered_effort;
mod forces;
mod joint_sample;
mod joints;
mod monitor;
mod names;
mod payload;
mod pose;
mod pose_sample;
mod recorded;
mod recorder;
mod run_dynamics;
mod running_check;
mod same_input;
mod sample;
mod sample_store;
mod space;
pub mod verdict;
mod watch;

pub use actuator_limits::ActuatorLimits;
pub use clock::RunClock;
pub use context::CheckContext;
pub use delivered_effort::{ConstantShare, DeliveredEffort};
pub use joint_sample::{ContactForce, JointSample, JointStateView, SetpointView, StepForces};
pub use monitor::{Monitor, Observed};
pub use names::Names;
pub use payload::{HEAVIEST_KG, RunPayload, taken_too_late, too_heavy};
pub use pose::agreement_tolerance;
pub use pose_sample::{ComparedPoses, PoseSample};
pub use recorder::{NoRecorder, Recorder, Recorders, RecordingError};
pub use run_dynamics::RunDynamics;
pub use running_check::{RunningCheck, write_out_limits};
pub use same_input::SameInput;
pub use sample::{Interruption, LeftOutInstants, PoseChange, Sample};
pub use sample_store::{SampleStore, StoredSample};
pub use space::JudgedPairs;
