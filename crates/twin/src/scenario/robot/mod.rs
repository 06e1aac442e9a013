//! What a scenario says of the robot itself: its controller.

mod controller;
mod joint_numbers;

pub use controller::ControllerSettings;
pub(crate) use controller::{CONTROLLER_KINDS, ControllerKind};
pub use joint_numbers::JointNumbers;
pub(crate) use joint_numbers::OTHERS;
