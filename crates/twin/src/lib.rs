//! Runs a robot's analytical model and its physics twin side by side, compares them at every
//! sample, checks clearances and limits, reports and records.

pub mod basics;
mod batch;
mod by_joint;
pub mod calibration;
pub mod certificate;
pub mod check;
pub mod clearance;
mod configurations;
pub mod conversion;
pub mod distances;
mod execute;
pub mod forward;
pub mod inverse;
pub mod jacobians;
mod json_list;
pub mod ladder;
pub mod model;
pub mod monitor;
pub mod motion;
pub mod plot;
mod probed;
pub mod proximity;
pub mod recorder;
#[cfg(feature = "recording")]
pub mod recording;
pub mod report;
mod run;
mod sample;
pub mod scenario;
pub mod study;
pub mod verdict;

pub use batch::{JointState, configuration, read_configurations, read_states};
pub use by_joint::ByJoint;
pub use configurations::{AxisStep, axis_steps, probe_configurations, random_configurations};
pub use execute::{ExecuteError, Options, execute};
pub use run::{Outcome, Run, RunError};
pub use sample::{LinkError, Sample};
