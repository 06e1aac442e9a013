//! The checks of a scenario: those that it has by default, and whether its own mean something.

mod defaults;
mod examined;
mod tolerances;

pub(super) use defaults::default_checks;
pub(super) use examined::{examine_checks, needs_shapes};
