//! The physics twin: a rapier multibody built from a robot description.
//!
//! Everything at the border is nalgebra and the description's types; rapier stays inside. It is
//! a source of its own: it takes poses, mass matrix and gravity torque from rapier and shares
//! no formula with the analytical model.

mod actuation;
mod adapter;
mod build;
mod contact;
mod engine;
mod error;
mod lumping;
mod sets;
mod settings;
mod world;

pub use actuation::{Commands, Controller, Gains, JointsView, Motor, Setpoint, controller, controller_names};
pub use error::SimulationError;
pub use settings::{Obstacle, WorldSettings};
pub use world::{World, WorldSnapshot};

/// Name and version of the physics engine, as reports give it; a repository test holds it
/// against the manifest.
pub const ENGINE: &str = "rapier3d-f64 0.36.1";
