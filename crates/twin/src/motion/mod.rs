//! Motions: planned moves, servos, and the setpoints that they give the joints.

mod course;
mod joint_move;
mod planning;
mod reference_generator;
mod tcp_move;
mod tcp_servo;
#[cfg(test)]
mod tests;
mod trajectory;

pub use course::{Course, JointMove, Motion, TcpServo};
pub use reference_generator::ReferenceGenerator;
pub(crate) use tcp_servo::DEFAULT_GAIN_PER_S;
pub use tcp_servo::ServoResult;
pub use trajectory::Trajectory;
