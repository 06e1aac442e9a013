//! Causes in how a joint is declared: its axis, kind, order, ratio and zero.

pub(super) mod axis;
pub(super) mod fixed_joint;
pub(super) mod kind;
pub(super) mod order;
pub(super) mod ratio;
pub(super) mod zero;
