//! What a scenario says of the robot itself: its controller, its actuators, its sensors, and what it carries.

mod actuators;
mod controller;
mod joint_numbers;
mod payload;
mod sensors;

pub use actuators::JointSettings;
pub use controller::ControllerSettings;
pub(crate) use controller::{CONTROLLER_KINDS, ControllerKind};
pub use joint_numbers::JointNumbers;
pub(crate) use joint_numbers::OTHERS;
pub use payload::{PayloadInertia, PayloadSettings};
pub use sensors::{SensorSettings, VelocitySensor};
