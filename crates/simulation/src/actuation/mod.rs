//! From state and setpoint to commands for the actuators: the trait of controllers and the simplest of them. Those that
//! know a model of the robot, or sensors, are above this crate.

pub(crate) mod commands;
pub(crate) mod connection;
mod controller;
mod joints_view;
mod kinematic;
mod passive;
mod pd;
mod torque;

pub use commands::{Commands, Gains, Motor};
pub use connection::DriveConnection;
pub use controller::Controller;
pub use joints_view::{JointsView, MeasuredState, Setpoint};
pub use kinematic::Kinematic;
pub use passive::Passive;
pub use pd::Pd;
pub use torque::Torque;
