//! Analytical kinematics: Denavit-Hartenberg tables, screws and URDF chains.
//!
//! Three forward kinematics of one robot, each by its own path, so that they can be compared with
//! each other: [`DhChain`] (a table), [`UrdfTree`] (joint after joint) and [`ScrewTree`] (products
//! of exponentials). Nothing here reads a file, a clock or a random number, and calls that are
//! made per sample allocate nothing.
//!
//! Units are metres and radians; `a_from_b` is the pose of frame b in frame a.

mod arm;
pub mod best_first;
mod chain;
mod configurations;
mod error;
pub mod least_squares;
mod link_poses;
mod spatial;
mod uniform;

#[cfg(test)]
#[path = "../tests/support/mod.rs"]
mod support;

pub use arm::{
    Arm, ArmJoint, Dexterity, DifferentialMethod, Displacement, IkChange, IkMethod, IkOptions, IkResult,
    IkSolver, IkTarget, Manipulability, Sampling, TargetPart, VelocityEllipsoid, Workspace, WorkspaceSize,
    displacement, maximize,
};
pub use chain::{
    Axes, AxisPair, AxisRelation, Choice, DeriveError, DhChain, DhDerivation, DhDerivatives, DhFrames,
    DhRowTwists, FreeChoice, Jacobian, JacobianKind, ModifiedDh, NotADhTransform, Proof, ROUNDED_M,
    ROUNDED_RAD, RoundedPair, ScrewChain, ScrewDerivatives, ScrewTree, SerialChain, SerialDh, SinCos,
    StandardDh, UrdfTree, derive_dh, without_rounding,
};
pub use configurations::{
    AxisStep, UNRANGED_SLIDE_M, axis_steps, move_inside_limits, random_configurations, range,
    sample_configurations,
};
pub use error::KinematicsError;
pub use link_poses::{LinkPoses, LinkPosesError};
pub use spatial::{
    DeterminedAngles, EulerAngles, EulerSet, Pose, PoseError, ReportedPose, Screw, ToolAxes, ToolAxesError,
    Twist, UnknownEulerSet, Wrench, frame_about, hat, larger, log_ratio, quaternion_of, rotation_exp,
    rotation_log, vee,
};
pub use uniform::Uniform;
