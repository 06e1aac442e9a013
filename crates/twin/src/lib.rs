//! Runs a robot's analytical model and its physics twin side by side, compares them at every
//! sample, checks clearances and limits, and reports.
//!
//! [`scenario`] is a scenario as plain data, [`setup`] checks it against its robot, [`Run`] is the loop over a
//! [`source`] of joint states, [`monitor`] holds the checks, and [`execute`] does all of it for one scenario.

pub mod bodies;
pub mod comparison;
mod control;
pub mod diagnosis;
mod execute;
pub mod fault;
pub mod monitor;
pub mod motion;
pub mod proximity;
pub mod recorder;
pub mod report;
pub mod results;
mod run;
mod sample;
pub mod scenario;
pub mod setup;
pub mod source;
mod stopping;
pub mod trajectory_file;
pub mod verdict;
mod words;

pub use control::JointController;
pub use execute::{ExecuteError, IfIncomplete, Options, Recording, RecordingFormat, execute, finished};
pub use run::{Outcome, Run, RunError};
pub use sample::Sample;
pub use setup::RunSetup;
