//! Friction, masses and torque constants of a robot from a log: `congruent identify`.

mod identified_log;
mod recorded_efforts;
mod request;

pub use identified_log::{IdentifiedLog, identify_log};
pub use request::{FreeGroup, IdentifyRequest};
