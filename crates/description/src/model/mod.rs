//! The validated robot: links, joints and their tree, the table that models its chain, and joint values.

pub(crate) mod description;
pub(crate) mod dh_table;
pub(crate) mod geometry;
pub(crate) mod inertia;
pub(crate) mod joint;
pub(crate) mod joint_values;
pub(crate) mod link;
pub(crate) mod positions;
pub(crate) mod robot;
pub(crate) mod tree;

pub use description::{RobotDescription, Tolerance};
pub use dh_table::{DhConvention, DhRow, DhRowKind, DhTable};
pub use geometry::{Geometry, Mesh, Shape};
pub use inertia::Inertia;
pub use joint::{Joint, JointIndex, JointKind, JointLimit, Mimic};
pub use joint_values::JointValues;
pub use link::{Link, LinkIndex};
pub use positions::{ArmQ, ChainQ, RobotQ};
pub use robot::{JointParts, Robot, RobotError};
