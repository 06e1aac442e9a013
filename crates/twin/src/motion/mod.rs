//! Motions: planned moves, servos, and the setpoints that they give the joints.

mod course;
mod joints;
mod pace;
#[cfg(test)]
mod planned_tests;
mod planning;
mod reference_generator;
mod tcp;
#[cfg(test)]
mod tests;
mod trajectory;

pub use course::{Course, Motion, PlannedMove, TcpServo, Way};
pub use joints::{JointSpline, JointTable, SplineEnds};
pub use pace::{MotionLimits, Pace, RateLimits, SpeedProfile, Stretch};
pub use reference_generator::{MotionError, ReferenceGenerator};
pub(crate) use tcp::tcp_servo::DEFAULT_GAIN_PER_S;
pub use tcp::tcp_servo::ServoResult;
pub(crate) use trajectory::MotionInput;
pub use trajectory::Trajectory;
