//! Commands about one arm: what it reaches, how well, and how far it is from collisions.

pub(crate) mod acm;
pub(crate) mod clearance;
pub(crate) mod dynamics;
pub(crate) mod fk;
pub(crate) mod ik;
pub(crate) mod jacobian;
mod length;
pub(crate) mod manipulability;
pub(crate) mod sensitivity;
pub(crate) mod workspace;
