//! What the scenario says of controllers and actuators, checked against its robot.

mod all;
mod controller;
mod joint_numbers;
mod limits;
mod payloads;
mod resistances;
mod sensors;
mod torque_table;

pub(super) use all::Actuation;
pub use controller::ControllerSetup;
pub(crate) use controller::Sampling;
pub(crate) use limits::ActuatorLimits;
pub use sensors::SensorSetup;
pub use torque_table::TorqueTable;
