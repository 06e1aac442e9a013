//! From state and setpoint to commands for the actuators: the trait of controllers and the simplest of them. Those that
//! know a model of the robot, or sensors, are above this crate.

pub(crate) mod connection;
mod controller;
mod kinematic;
mod passive;
mod pd;
mod torque;

pub use connection::DriveConnection;
pub use controller::Controller;
pub use kinematic::Kinematic;
pub use passive::Passive;
pub use pd::Pd;
pub use torque::Torque;
