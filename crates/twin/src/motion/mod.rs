//! Motions: planned moves, servos, and the setpoints that they give the joints.

mod course;
mod excess;
mod joints;
#[cfg(test)]
mod planned_tests;
mod planning;
mod reference_generator;
mod tcp;
#[cfg(test)]
mod tests;
mod timing;
mod trajectory;

pub use course::{Course, Motion, PlannedMove, TcpServo, Way};
pub use joints::{JointSpline, JointTable, SplineEnds};
pub use reference_generator::{MotionError, ReferenceGenerator, SlowedMotion};
pub(crate) use tcp::drive::{ACCELERATION_M_S2, default_jerk_m_s3};
pub(crate) use tcp::tcp_servo::DEFAULT_GAIN_PER_S;
pub use tcp::tcp_servo::ServoResult;
pub use timing::{MotionLimits, Pace, RateLimits, SpeedProfile, Stretch};
pub(crate) use trajectory::MotionInput;
pub use trajectory::Trajectory;
