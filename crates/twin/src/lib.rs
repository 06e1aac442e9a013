//! The run loop: a robot's analytical model and its physics twin side by side, compared at every sample.
//!
//! [`RunSetup`] is a scenario checked against its robot, [`Run`] the loop over a [`source`] of joint states.

pub mod codes;
mod control;
pub mod fault;
mod outcome;
mod random_streams;
mod run;
mod same_poses;
pub mod setup;
pub mod source;
mod stopping;

pub use control::JointController;
pub use outcome::{Outcome, RunError};
pub use run::{Run, RunObserver};
pub use setup::{CaseValue, KnownValues, LoadRobot, RunSetup, UncertainCase, is_of_the_run};
