//! Settings of a scenario for the robot itself: its controller, actuators, sensors and payloads.

mod actuators;
mod controller;
mod joint_numbers;
mod payload;
mod sensors;

pub use actuators::JointSettings;
pub use controller::{CONTROLLER_KINDS, ControllerKind, ControllerSettings};
pub use joint_numbers::{JointNumbers, OTHERS};
pub use payload::{PayloadInertia, PayloadSettings};
pub use sensors::{SensorSettings, VelocitySensor};
