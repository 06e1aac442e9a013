//! Inverse kinematics by iteration: which configuration brings the tool to a pose? "Did not
//! converge" is a result, with what is left. How one step is computed is `step.rs`; what is measured
//! is `residual.rs`.

mod nearest;
mod residual;
mod solver;
mod step;

use congruent_description::ArmQ;

pub use residual::{IkTarget, TargetPart};
pub use solver::IkSolver;

/// How the next configuration is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum IkMethod {
    /// Levenberg-Marquardt with damping by the error that is left, joints held at their limits, and
    /// seeded random restarts.
    ///
    /// Source: Sugihara, *Solvability-Unconcerned Inverse Kinematics by the Levenberg-Marquardt
    /// Method* (2011), with the damping of Chan & Lawrence (1988); limits by projection.
    #[default]
    LevenbergMarquardt,
    /// Newton-Raphson with the body twist of the matrix logarithm as error.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 6.2.2.
    Newton,
    /// Position error and turn error through the pseudo-inverse of the geometric Jacobian.
    ///
    /// Source: Siciliano et al., *Robotics* (2009), eq. 3.74 with unit gain and step.
    PseudoInverse,
    /// The same errors through the transpose of the Jacobian, with the gain that would be best if
    /// the arm were linear.
    ///
    /// Source: Buss, *Introduction to Inverse Kinematics* (2009), eq. 7.
    Transpose,
}

/// How joint speeds follow from the error of a tool, in a loop that is closed from outside:
/// [`IkSolver::change_towards`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DifferentialMethod {
    /// Position error and turn error through the pseudo-inverse of the geometric Jacobian, damped in
    /// directions in which the arm is nearly singular: where the singular value is less than a
    /// twentieth of the largest, the joints are asked for less than the whole error, and for nothing
    /// where it is zero.
    ///
    /// Source: Siciliano et al., *Robotics* (2009), eq. 3.74; damping by Maciejewski & Klein (1988).
    #[default]
    PseudoInverse,
    /// As [`IkMethod::Transpose`].
    Transpose,
}

/// What would close the error if the arm were linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkChange<'a> {
    /// Change of each joint of the arm, rad or m; 0 for a joint that a limit holds.
    pub change: &'a [f64],
    /// Distance to the target, m.
    pub residual_position_m: f64,
    /// Angle to the target, rad; 0 where no orientation is asked for.
    pub residual_orientation_rad: f64,
    /// Indices of the arm's joints that stand at a limit which the error pushes them against.
    pub limits_held: &'a [usize],
}

/// When a solution counts, and how much is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkOptions {
    /// How steps are found.
    pub method: IkMethod,
    /// Largest distance that counts as reached, m.
    pub tolerance_m: f64,
    /// Largest angle that counts as reached, rad.
    pub tolerance_rad: f64,
    /// Steps of all attempts together.
    pub max_iterations: usize,
    /// Seed of the restarts.
    pub seed: u64,
}

impl Default for IkOptions {
    /// A nanometre and a nanoradian, as robot files count two poses as the same, and steps for
    /// some milliseconds.
    fn default() -> Self {
        Self {
            method: IkMethod::default(),
            tolerance_m: 1e-9,
            tolerance_rad: 1e-9,
            max_iterations: 5000,
            seed: 0,
        }
    }
}

/// What came of a solution: the best configuration that was seen, always within the limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkResult<'a> {
    /// The configuration, one entry for each joint of the arm.
    pub q: &'a ArmQ,
    /// Whether both residuals are within tolerance.
    pub converged: bool,
    /// Distance that is left, m.
    pub residual_position_m: f64,
    /// Angle that is left, rad; 0 where no orientation was asked for.
    pub residual_orientation_rad: f64,
    /// Steps of all attempts.
    pub iterations: usize,
    /// Indices of the arm's joints that stand at a limit.
    pub limits_held: &'a [usize],
}
