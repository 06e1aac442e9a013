//! The validated robot: links, joints and their tree, the table that models its chain, and joint values.

pub(crate) mod dh_table;
mod error;
pub(crate) mod geometry;
pub(crate) mod inertia;
pub(crate) mod joint;
pub(crate) mod joint_values;
pub(crate) mod link;
pub(crate) mod robot;
pub(crate) mod tolerance;
mod tree;

pub use dh_table::{DhConvention, DhRow, DhRowKind, DhTable};
pub use error::RobotError;
pub use geometry::{Geometry, Mesh, Shape};
pub use inertia::Inertia;
pub use joint::{Joint, JointIndex, JointKind, JointLimit, JointParts, Mimic};
pub use joint_values::{ByJoint, NamedValue, as_map};
pub use link::{Link, LinkIndex};
pub use robot::Robot;
pub use tolerance::Tolerance;
