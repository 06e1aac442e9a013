//! The checks of a scenario: default checks, and whether its own checks are consistent and can fail.

mod defaults;
mod examined;
mod tolerances;

pub(super) use defaults::default_checks;
pub(super) use examined::{examine_checks, needs_shapes};
