//! Motions of the tool centre point: to a pose by moving the joints, along lines and arcs, by a servo.

pub(super) mod drive;
mod geometry;
mod inverse;
pub(super) mod path;
mod segment;
pub(super) mod tcp_move;
pub(super) mod tcp_servo;
pub use drive::{ACCELERATION_M_S2, default_jerk_m_s3};
pub use tcp_servo::DEFAULT_GAIN_PER_S;
