//! The results of inverse kinematics.

use congruent_description::ArmQ;

/// The change of the joints that would remove the error if the arm were linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkChange<'a> {
    /// Change of each joint of the arm, rad or m; 0 for a joint that is kept at its limit.
    pub change: &'a [f64],
    /// Distance to the target, m.
    pub residual_position_m: f64,
    /// Angle to the target, rad; 0 if the target prescribes no orientation.
    pub residual_orientation_rad: f64,
    /// Indices of the arm's joints that are at a limit and that the error would push beyond it.
    pub limits_held: &'a [usize],
}

/// The result of a search: the best configuration that was found, always within the limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkResult<'a> {
    /// The configuration, one entry for each joint of the arm.
    pub q: &'a ArmQ,
    /// Whether both residuals are within tolerance.
    pub converged: bool,
    /// Distance to the target, m.
    pub residual_position_m: f64,
    /// Angle to the target, rad; 0 if the target prescribes no orientation.
    pub residual_orientation_rad: f64,
    /// Number of steps of all attempts.
    pub iterations: usize,
    /// Indices of the arm's joints that are at a limit.
    pub limits_held: &'a [usize],
}
