//! An arm: a chain with limits and tool, with its inverse kinematics, workspace, manipulability and sensitivity.

pub(crate) mod ik;
pub(crate) mod manipulability;
pub(crate) mod model;
pub(crate) mod pattern_search;
pub(crate) mod sensitivity;
mod spread;
pub(crate) mod workspace;
mod workspace_size;

pub use ik::{DifferentialMethod, IkChange, IkMethod, IkOptions, IkResult, IkSolver, IkTarget, TargetPart};
pub use manipulability::{Dexterity, Manipulability, VelocityEllipsoid};
pub use model::{Arm, ArmJoint};
pub use pattern_search::maximize;
pub use sensitivity::{Displacement, Sampling, displacement};
pub use workspace::Workspace;
pub use workspace_size::WorkspaceSize;
