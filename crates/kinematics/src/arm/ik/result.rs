//! What inverse kinematics answers.

use congruent_description::ArmQ;

/// What would close the error if the arm were linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkChange<'a> {
    /// Change of each joint of the arm, rad or m; 0 for a joint that a limit holds.
    pub change: &'a [f64],
    /// Distance to the target, m.
    pub residual_position_m: f64,
    /// Angle to the target, rad; 0 if no orientation is asked for.
    pub residual_orientation_rad: f64,
    /// Indices of the arm's joints that stand at a limit which the error pushes them against.
    pub limits_held: &'a [usize],
}

/// What came of a solution: the best configuration that was seen, always within the limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkResult<'a> {
    /// The configuration, one entry for each joint of the arm.
    pub q: &'a ArmQ,
    /// Whether both residuals are within tolerance.
    pub converged: bool,
    /// Distance to the target, m.
    pub residual_position_m: f64,
    /// Angle to the target, rad; 0 if no orientation was asked for.
    pub residual_orientation_rad: f64,
    /// Steps of all attempts.
    pub iterations: usize,
    /// Indices of the arm's joints that stand at a limit.
    pub limits_held: &'a [usize],
}
