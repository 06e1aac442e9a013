//! The surroundings of the robot: obstacles, grasps and zones.

mod bodies;
mod jumps;
mod overlaps;
mod reach;
mod spaces;
mod zones;

pub(super) use bodies::{Surroundings, mobility};
pub(super) use jumps::jumps;
pub(super) use overlaps::{FirstStep, overlaps};
pub(super) use reach::DEFAULT_REACH_M;
pub(crate) use spaces::LARGEST_M;
pub(super) use zones::{build as zones, paired_with_checks};
