//! The fast serial chain: pose and Jacobian in one pass, and batches of configurations.

pub(crate) mod batch;
pub(crate) mod chain;
pub(crate) mod steps;
