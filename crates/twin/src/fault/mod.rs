//! Faults of the twin: `[[fault]]` of a scenario, checked against the robot ([`PlannedFault`]) and acting in a run. The model,
//! the controllers and the checks do not know of them.

mod drives;
mod encoders;
mod injected;
mod judgement;
mod planned;
mod resolve;
mod run_fault;
mod tool;
mod transport;

pub(crate) use injected::InjectedFaults;
pub use judgement::{Judgement, judge};
pub use planned::{FaultAction, PlannedFault};
pub(crate) use resolve::resolve;
pub use run_fault::{FaultQuantity, RunFault};
