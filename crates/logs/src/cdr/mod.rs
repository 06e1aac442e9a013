//! Messages of ROS 2 as DDS writes them: Common Data Representation (CDR).

mod message;
mod reader;
pub(crate) mod write;

pub(crate) use message::{Decoded, DecodedPose, MessageKind};
pub(crate) use reader::CdrFault;
pub(crate) use write::{CdrText, joint_state_text};

/// What logs call this encoding.
pub(crate) const CDR: &str = "cdr";
