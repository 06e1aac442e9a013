//! The physics twin: a rapier multibody built from a robot description.
//!
//! The interface has nalgebra's and the description's types; rapier stays inside. Poses, mass matrix and
//! gravity torque come from rapier: no formula is shared with the analytical model.

mod actuation;
mod adapter;
mod build;
mod changes;
mod commands;
mod contact;
mod drive;
mod engine;
mod engine_changes;
mod engine_contacts;
mod engine_forces;
mod error;
mod joints_view;
mod lumping;
mod sets;
mod settings;
mod world;

pub use actuation::{Controller, DriveConnection, Kinematic, Passive, Pd, Torque};
pub use commands::{Commands, Gains, Motor};
pub use drive::Saturation;
pub use error::SimulationError;
pub use joints_view::{JointsView, MeasuredState, Setpoint};
pub use settings::{PairForce, Touches, WorldSettings};
pub use world::{World, WorldSnapshot};

/// Name and version of the physics engine, as reports give it; a test of the workspace compares it
/// with the manifest.
pub const ENGINE: &str = "rapier3d-f64 0.36.1";
