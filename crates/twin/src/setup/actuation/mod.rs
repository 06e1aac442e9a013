//! What the scenario says of controllers and actuators, checked against its robot.

mod all;
mod controller;
mod joint_numbers;
mod payloads;
mod resistances;
mod sensors;
mod torque_table;

pub(super) use all::Actuation;
pub(crate) use controller::ControlPeriod;
pub use controller::ControllerSetup;
pub use sensors::SensorSetup;
pub use torque_table::TorqueTable;
