//! Commands about one arm: what it reaches, how well, and how far it is from collisions.

mod base_parameters;
pub(crate) mod clearance;
mod disabled_pairs;
pub(crate) mod dynamics;
pub(crate) mod fk;
pub(crate) mod ik;
pub(crate) mod jacobian;
pub(crate) mod manipulability;
pub(crate) mod sensitivity;
pub(crate) mod tolerances;
pub(crate) mod workspace;
