//! The physics twin: a rapier multibody built from a robot description.
//!
//! The interface has nalgebra's and the description's types; rapier stays inside. Poses, mass matrix and
//! gravity torque come from rapier: no formula is shared with the analytical model.

mod actuation;
mod adapter;
mod build;
mod carried;
mod changes;
mod contact;
mod drive;
mod engine;
mod engine_changes;
mod error;
mod lumping;
mod sets;
mod settings;
mod world;

pub use actuation::{
    Commands, Controller, DriveConnection, Gains, JointsView, Kinematic, MeasuredState, Motor, Passive, Pd,
    Setpoint, Torque,
};
pub use carried::CarriedBody;
pub use drive::{SPEED_MARGIN, Saturation};
pub use error::SimulationError;
pub use settings::{Obstacle, Touches, WorldSettings};
pub use world::{World, WorldSnapshot};

/// Name and version of the physics engine, as reports give it; a test of the workspace compares it
/// with the manifest.
pub const ENGINE: &str = "rapier3d-f64 0.36.1";
