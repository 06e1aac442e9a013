//! Analytical kinematics: Denavit-Hartenberg tables, screws and URDF chains.
//!
//! Three forward kinematics of one robot, each by its own path, so that they can be held against
//! each other: [`DhChain`] (a table), [`UrdfTree`] (joint after joint) and [`ScrewTree`] (products
//! of exponentials). Nothing here reads a file, a clock or a random number, and calls that are
//! made per sample allocate nothing.
//!
//! Units are metres and radians; `a_from_b` is the pose of frame b in frame a.

mod adjoint;
pub mod agreement;
mod arm;
pub mod calibration;
mod climb;
mod dh;
mod elementary;
mod error;
mod euler;
mod ik;
mod jacobian;
mod jacobian_derivative;
mod manipulability;
mod pose;
mod proof;
mod rotation;
mod screw_chain;
mod screw_derivatives;
mod screw_tree;
mod sensitivity;
mod serial_batch;
mod serial_chain;
mod serial_steps;
mod sin_cos;
mod tool_axes;
mod twist;
mod twist_algebra;
mod uniform;
mod urdf_tree;
mod workspace;
mod wrench;

#[cfg(test)]
#[path = "../tests/support/mod.rs"]
mod support;

pub use agreement::{Bracket, Budget, Certificate, certify, certify_driven};
pub use arm::{Arm, ArmJoint};
pub use dh::{
    AxisPair, AxisRelation, Choice, DeriveError, DhChain, DhDerivation, DhDerivatives, DhFrames, DhRowTwists,
    FreeChoice, ModifiedDh, NotADhTransform, SerialDh, SerialDhRow, StandardDh, derive_dh,
};
pub use error::KinematicsError;
pub use euler::{DeterminedAngles, EulerAngles, EulerSet};
pub use ik::{DifferentialMethod, IkChange, IkMethod, IkOptions, IkResult, IkSolver, IkTarget, TargetPart};
pub use jacobian::{Jacobian, JacobianKind};
pub use manipulability::{Dexterity, Manipulability, VelocityEllipsoid};
pub use pose::Pose;
pub use proof::Proof;
pub use rotation::{hat, rotation_exp, rotation_log, vee};
pub use screw_chain::ScrewChain;
pub use screw_derivatives::ScrewDerivatives;
pub use screw_tree::ScrewTree;
pub use sensitivity::{Displacement, Sampling, displacement};
pub use serial_chain::SerialChain;
pub use tool_axes::{ToolAxes, ToolAxesError};
pub use twist::{Screw, Twist};
pub use urdf_tree::UrdfTree;
pub use workspace::Workspace;
pub use wrench::Wrench;
