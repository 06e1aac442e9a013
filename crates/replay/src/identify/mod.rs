//! Friction, masses and torque constants of a robot from a log: `congruent identify`.

mod identified_log;
mod link_distances;
mod plan;
mod plan_report;
mod recorded_efforts;
mod request;

pub use identified_log::{IdentifiedLog, identify_log};
pub use plan::{PLAN_FILES, PlanRequest, PlannedMotion, plan_excitation, plan_text};
pub use plan_report::{PlanReport, PlannedTerm};
pub use request::IdentifyRequest;
