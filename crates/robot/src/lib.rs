//! The validated robot: links, joints and their tree, the table that models its chain, and joint values.
//!
//! Nothing here reads a file: the readers are in crate `description`, under whose name all types are used.

mod carried_body;
mod declared_tolerances;
mod dh_table;
mod driven;
mod error;
mod extent;
mod geometry;
mod inertia;
mod joint;
mod joint_limit;
mod joint_mapping;
mod joint_resistance;
mod joint_values;
mod link;
mod obstacle;
mod placed_axis;
mod pose_rounding;
mod positions;
mod robot;
mod robot_q_list;
mod rounding;
mod set_value;
mod tolerance;
mod tree;
mod written_names;
mod written_tolerances;

pub use carried_body::CarriedBody;
pub use declared_tolerances::{
    DeclaredTolerances, ErrorDistribution, FrameTolerances, JointTolerances, ParameterTolerances,
};
pub use dh_table::{DhConvention, DhRow, DhRowKind, DhTable};
pub use driven::{DrivenCoordinates, Followers};
pub use error::RobotError;
pub use extent::Extent;
pub use geometry::{Geometry, Shape};
pub use inertia::{Inertia, principal_moments};
pub use joint::{Joint, JointIndex, JointKind, JointParts, Mimic, SPEED_MARGIN};
pub use joint_limit::JointLimit;
pub use joint_mapping::MappedJoint;
pub use joint_resistance::JointResistance;
pub use joint_values::JointValues;
pub use link::{Link, LinkIndex};
pub use obstacle::Obstacle;
pub use placed_axis::PlacedAxis;
pub use pose_rounding::motions_of_pose;
pub use positions::{ArmQ, ChainQ, RobotQ};
pub use robot::Robot;
pub use robot_q_list::RobotQList;
pub use rounding::{InertiaRounding, JointForm, JointRounding, JointValueRounding, SmallMotion};
pub use tolerance::{RequestedTolerance, Tolerance};
pub use written_names::WrittenNames;
pub use written_tolerances::WrittenTolerances;
