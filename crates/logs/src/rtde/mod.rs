//! The stream of a robot of Universal Robots: RTDE, the real-time data exchange of its controller, version 2, over TCP.
//!
//! Source: Universal Robots, *Real-Time Data Exchange (RTDE) Guide*. What is sent: the version, which outputs are wanted, start
//! and pause. Inputs of the robot are never set up, so that nothing can be written to it.

mod connection;
mod listen;
mod outputs;
mod package;

pub use connection::RtdeOptions;
pub use listen::listen_to_rtde;
pub use outputs::RTDE_JOINTS;

/// The port of RTDE.
pub const RTDE_PORT: u16 = 30_004;
