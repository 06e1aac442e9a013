//! The limits that planned moves keep.

use congruent_scenario::OverLimit;

/// Limits of all joints, one entry for each movable joint; infinity for none.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionLimits {
    /// Largest speeds, rad/s or m/s.
    pub velocity: Vec<f64>,
    /// Largest accelerations of moves of least time, rad/s^2 or m/s^2.
    pub acceleration: Vec<f64>,
    /// Largest jerks of moves of least time, rad/s^3 or m/s^3.
    pub jerk: Vec<f64>,
    /// Only the accelerations that the scenario or the robot file declares, infinity for none: every planned move keeps them.
    pub declared_acceleration: Vec<f64>,
    /// Only the jerks that are declared, infinity for none: every planned move keeps them.
    pub declared_jerk: Vec<f64>,
    /// What happens to a move that breaks a limit.
    pub over_limit: OverLimit,
}
