//! Controllers: from state and setpoint to commands for the actuators. A new controller is a file here and a
//! line in the list of `known.rs`.

pub(crate) mod commands;
pub(crate) mod connection;
mod controller;
mod gains;
mod gravity_compensation;
mod joints_view;
mod kinematic;
mod known;
mod passive;
mod pd;

pub use commands::{Commands, Motor};
pub use connection::DriveConnection;
pub use controller::{CloneController, Controller};
pub use gains::Gains;
pub use joints_view::{JointsView, MeasuredState, Setpoint};
pub use known::{controller, controller_names};
