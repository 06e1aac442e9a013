//! Checks of forces.

mod dynamics;
mod effort;
mod not_evaluated;
mod power;

pub(super) use dynamics::{DynamicsMonitor, RELATIVE_PER_S as DYNAMICS_RELATIVE_PER_S};
pub(super) use effort::{EffortMonitor, RELATIVE as EFFORT_RELATIVE};
pub(super) use power::{PowerMonitor, RELATIVE_PER_S as POWER_RELATIVE_PER_S};
