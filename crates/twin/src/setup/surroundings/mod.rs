//! The surroundings of the robot: obstacles, grasps and zones.

mod bodies;
mod overlaps;
mod spaces;
mod zones;

pub(super) use bodies::{Surroundings, mobility};
pub(super) use overlaps::{FirstStep, overlaps};
pub(crate) use spaces::LARGEST_M;
pub(super) use zones::{build as zones, paired_with_checks};
