//! Of several solutions the one nearest to the arm's configuration.

use congruent_description::ArmQ;

use super::{options::IkOptions, residual::IkTarget, result::IkResult, solver::IkSolver};
use crate::{error::KinematicsError, uniform::Uniform};

impl IkSolver {
    /// The solution that moves the joints least: of the one found from `start` and those found from
    /// `attempts` random configurations.
    ///
    /// Nearest is the least sum of squares of the changes, metres taken as radians by
    /// [`crate::Arm::metres_per_rad`]. An arm with more joints than the task needs has endless
    /// solutions, of which this is a near one.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `start` is no configuration of the arm.
    pub fn solve_nearest(
        &mut self,
        target: &IkTarget,
        start: &ArmQ,
        options: &IkOptions,
        attempts: usize,
    ) -> Result<IkResult<'_>, KinematicsError> {
        let mut random = Uniform::seeded(options.seed);
        let mut from = start.clone();
        let mut nearest = (f64::INFINITY, start.clone());
        for _ in 0..=attempts {
            let converged = self.solve(target, &from, options, || true)?.converged;
            if converged {
                let distance = self.turn_towards(start);
                if distance < nearest.0 {
                    nearest = (distance, self.solution().clone());
                }
            }
            self.arm().draw(&mut random, &mut from);
        }
        let from = if nearest.0.is_finite() { &nearest.1 } else { start };
        // Already there, or else the best that can be said about the target.
        self.solve(target, from, options, || true)
    }
}
