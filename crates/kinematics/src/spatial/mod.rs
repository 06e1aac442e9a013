//! Rigid motions and what goes with them: poses, twists, wrenches, rotations and their angles.

pub(crate) mod adjoint;
pub(crate) mod elementary;
pub(crate) mod euler;
pub(crate) mod pose;
pub(crate) mod pose_error;
pub(crate) mod reported_pose;
pub(crate) mod rotation;
pub(crate) mod tool_axes;
pub(crate) mod twist;
pub(crate) mod twist_algebra;
pub(crate) mod wrench;

pub use euler::{DeterminedAngles, EulerAngles, EulerSet, UnknownEulerSet};
pub use pose::Pose;
pub use pose_error::{PoseError, larger};
pub use reported_pose::ReportedPose;
pub use rotation::{frame_about, hat, quaternion_of, rotation_exp, rotation_log, vee};
pub use tool_axes::{ToolAxes, ToolAxesError};
pub use twist::{Screw, Twist, log_ratio};
pub use wrench::Wrench;
