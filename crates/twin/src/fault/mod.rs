//! Faults of the twin: `[[fault]]` of a scenario, checked against the robot ([`PlannedFault`]) and acting in a run. The model,
//! the controllers and the checks do not know of them.

mod drives;
mod encoders;
mod injected;
mod planned;
mod resolve;
mod tool;
mod transport;

pub(crate) use injected::InjectedFaults;
pub use planned::{FaultAction, PlannedFault};
pub(crate) use resolve::resolve;
