//! What one instant of a run looks like to monitors and recorders.

use congruent_description::RobotQ;
use congruent_kinematics::{Pose, PoseError};
use nalgebra::Isometry3;

use crate::proximity::Clearance;

/// One instant: borrowed from the run loop, nothing is copied.
#[derive(Debug)]
pub struct Sample<'a> {
    /// Number of physics steps so far.
    pub step: u64,
    /// Simulated time.
    pub time_s: f64,
    /// Whether no step follows. Monitors see the end of the scenario, recorders also the end that
    /// a check has just made.
    pub is_last: bool,
    /// Joint positions of the twin, in the robot's order of movable joints.
    pub q: &'a RobotQ,
    /// Poses by analysis, in the root link's frame and the robot's order of links.
    pub model: &'a [Pose],
    /// Poses by physics, likewise.
    pub twin: &'a [Isometry3<f64>],
    /// Model against twin, link by link.
    pub errors: &'a [PoseError],
    /// Distances between links and to obstacles: measured where a monitor asks.
    pub clearance: &'a mut Clearance,
    /// Distances from links to the zones that are forbidden to them, likewise.
    pub zones: &'a mut Clearance,
}
