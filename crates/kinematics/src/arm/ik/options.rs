//! Options of inverse kinematics: the method, and when the search stops.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The method by which the next configuration is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum IkMethod {
    /// Levenberg-Marquardt with damping by the residual, joints held at their limits, and
    /// seeded random restarts.
    ///
    /// Source: Sugihara, *Solvability-Unconcerned Inverse Kinematics by the Levenberg-Marquardt
    /// Method* (2011), with the damping of Chan & Lawrence (1988); limits by projection.
    #[default]
    #[serde(rename = "lm")]
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
/// [`IkSolver::change_towards`](crate::IkSolver::change_towards).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DifferentialMethod {
    /// Position error and turn error through the pseudo-inverse of the geometric Jacobian, damped in
    /// directions in which the arm is nearly singular: if the singular value is less than a
    /// twentieth of the largest, the joints correct less than the whole error, and nothing
    /// if it is zero.
    ///
    /// Source: Siciliano et al., *Robotics* (2009), eq. 3.74; damping by Maciejewski & Klein (1988).
    #[default]
    PseudoInverse,
    /// The transpose of the Jacobian with the best gain, as [`IkMethod::Transpose`].
    Transpose,
}

/// Method, tolerances and effort of inverse kinematics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkOptions {
    /// Method of a step.
    pub method: IkMethod,
    /// Largest distance to the target at which it counts as reached, m.
    pub tolerance_m: f64,
    /// Largest angle to the target at which it counts as reached, rad.
    pub tolerance_rad: f64,
    /// Most steps of all attempts together.
    pub max_iterations: usize,
    /// Seed of the random restarts.
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
