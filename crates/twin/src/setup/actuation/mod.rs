//! What the scenario says of controllers and actuators, checked against its robot.

mod controller;
mod joint_numbers;
mod torque_table;

pub use controller::ControllerSetup;
pub(crate) use controller::Sampling;
pub use torque_table::TorqueTable;
