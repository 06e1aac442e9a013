//! What one instant of a run looks like to monitors and recorders.

use congruent_kinematics::Pose;
use nalgebra::Isometry3;

use crate::clearance::Clearance;

/// How far model and twin are apart at one link.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LinkError {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

impl LinkError {
    /// Between two poses of one link.
    pub fn of(a: &Pose, b: &Pose) -> Self {
        Self { position_m: a.distance_m(b), orientation_rad: a.angle_rad(b) }
    }

    /// Between a pose by analysis and the same link's pose by physics.
    pub fn between(model: &Pose, twin: &Isometry3<f64>) -> Self {
        Self::of(model, &Pose::from(*twin))
    }

    /// The larger of each.
    #[must_use]
    pub(crate) fn larger(self, other: Self) -> Self {
        Self {
            position_m: larger(self.position_m, other.position_m),
            orientation_rad: larger(self.orientation_rad, other.orientation_rad),
        }
    }
}

/// The larger of two. `max` would drop a NaN, and a NaN is the largest of all.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

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
    pub q: &'a [f64],
    /// Poses by analysis, in the root link's frame and the robot's order of links.
    pub model: &'a [Pose],
    /// Poses by physics, likewise.
    pub twin: &'a [Isometry3<f64>],
    /// Model against twin, link by link.
    pub errors: &'a [LinkError],
    /// Distances between links and to obstacles: measured where a monitor asks.
    pub clearance: &'a mut Clearance,
    /// Distances from links to the zones that are forbidden to them, likewise.
    pub zones: &'a mut Clearance,
}
