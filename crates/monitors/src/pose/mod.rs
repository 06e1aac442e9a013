//! Checks of link poses and of the tool.

mod agreement;
mod goal;
mod invariants;
mod joint_constraints;
mod twist;

pub(super) use agreement::AgreementMonitor;
pub use agreement::agreement_tolerance;
pub(super) use goal::{GoalMonitor, examine as examine_goal};
pub(super) use invariants::{InvariantsMonitor, default_rotation};
pub(super) use twist::{TwistMonitor, twist_limits};
