//! The stream of a robot of Universal Robots: RTDE, the real-time data exchange of its controller, version 2, over TCP.
//!
//! Source: Universal Robots, *Real-Time Data Exchange (RTDE) Guide*. What is sent: the version, which outputs are wanted, start
//! and pause. Inputs of the robot are never set up, so that nothing can be written to it.

mod connection;
mod listen;
mod options;
mod outputs;
mod package;

pub use listen::listen_to_rtde;
pub use options::{RTDE_JOINTS, RTDE_PORT, RtdeOptions};
