//! Motions: planned moves, servos, and the setpoints of the joints that follow from them. Only kinematics is known here, not
//! the physics: what a servo needs of it, the measured positions, is handed in.

pub mod codes;
mod joint_targets;
mod joints;
pub mod motion_limits;
mod motion_plan;
mod planning;
mod reference_generator;
mod spline;
mod tcp;
#[cfg(test)]
mod tests;
mod timing;
mod trajectory;
mod violation;

pub use joint_targets::{JointTargets, moving_joint};
pub use joints::JointTable;
pub use motion_plan::{JointSpacePath, Motion, MotionPlan, PlannedMove, TcpServo};
pub use reference_generator::{MotionError, ReferenceGenerator, SlowedMotion};
pub use spline::{JointSpline, SplineEnds};
pub use tcp::{ACCELERATION_M_S2, DEFAULT_GAIN_PER_S, default_jerk_m_s3, tcp_servo::ServoResult};
pub use timing::{MotionLimits, RateLimits, SpeedProfile, Stretch, TimeScaling};
pub use trajectory::{MotionInput, Trajectory};
