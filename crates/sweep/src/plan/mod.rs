//! The plan of a sweep: which values of a scenario vary, and how; from its file to the overrides of any case.

mod around;
mod distribution;
mod given;
mod key;
mod nominal;
mod of_scenario;
mod read;
mod requirement;
mod varied;
mod written;

pub use distribution::Distribution;
pub use read::{SweepCase, SweepPlan};
pub use varied::VariedKey;
pub use written::{WrittenPlan, sweep_plan_schema};
