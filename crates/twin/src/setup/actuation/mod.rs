//! What the scenario says of controllers and actuators, checked against its robot.

mod controller;
mod joint_numbers;
mod payloads;
mod resistances;
mod sensors;
mod torque_table;

pub use controller::ControllerSetup;
pub(crate) use controller::Sampling;
pub(super) use payloads::payloads;
pub(super) use resistances::resistances;
pub use sensors::SensorSetup;
pub use torque_table::TorqueTable;
