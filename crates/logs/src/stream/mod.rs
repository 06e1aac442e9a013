//! The joint states and poses that are taken from a log, in the order of their times: what a run needs of it.
//!
//! A row has the positions of all joints at one instant. Joints on several topics, and joints that a message lacks, are
//! interpolated between the messages beside it, never across a gap.

mod in_order;
mod joint_row;
mod joint_series;
mod pose_stream;
mod reader;
mod rows;
mod selection;

pub use joint_row::{JointRow, JointRowCounts};
pub use pose_stream::{PoseCounts, StreamedPose};
pub use reader::{LogStream, StreamEvent};
pub use selection::{SelectedJoint, SelectedJoints, SelectedPoses, StreamSelection};
