//! Finds, among several solutions, the one nearest to the arm's configuration.

use congruent_description::ArmQ;

use super::{options::IkOptions, residual::IkTarget, result::IkResult, solver::IkSolver};
use crate::{error::KinematicsError, uniform::Uniform};

/// The nearest solution found so far.
struct NearestSolution {
    /// Its distance from the start; infinite as long as there is none.
    distance: f64,
    q: ArmQ,
}

impl IkSolver {
    /// The solution that moves the joints least: of the one found from `start` and those found from
    /// `attempts` random configurations.
    ///
    /// Nearest is the least sum of squares of the changes, metres taken as radians by
    /// [`crate::Arm::metres_per_rad`]. An arm with more joints than the task needs has endless
    /// solutions, along which it is moved towards `start` as long as that brings it nearer.
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
        // The first attempt starts from `start` itself, so that no random attempt is needed to find a solution near it.
        let mut random = Uniform::seeded(options.seed);
        let mut from = start.clone();
        let mut nearest = NearestSolution { distance: f64::INFINITY, q: start.clone() };
        for _ in 0..=attempts {
            let converged = self.solve(target, &from, options, || true)?.converged;
            // Whole turns are taken out before distances are compared: they change no pose.
            if converged {
                let distance = self.turn_towards(start);
                if distance < nearest.distance {
                    nearest = NearestSolution { distance, q: self.solution().clone() };
                }
            }
            // After the try, so that the first one starts from `start`.
            self.arm().draw(&mut random, &mut from);
        }
        self.pull_towards(start, target, options, &mut nearest)?;
        let from = if nearest.distance.is_finite() { &nearest.q } else { start };
        // From a solution this converges at once and only fills the result; without one it gives the best residual.
        self.solve(target, from, options, || true)
    }

    /// Moves a solution part of the path to `start` and solves from there, as long as that gives a nearer one: steps of the
    /// least change lead back across the solutions, not along them.
    fn pull_towards(
        &mut self,
        start: &ArmQ,
        target: &IkTarget,
        options: &IkOptions,
        nearest: &mut NearestSolution,
    ) -> Result<(), KinematicsError> {
        /// First share of the path to `start`; halved whenever it leads to no nearer solution.
        const PART: f64 = 0.5;
        const LEAST_PART: f64 = 1e-3;
        /// Least relative decrease of the distance that counts as nearer.
        const NEARER: f64 = 1e-6;
        const MOST_ROUNDS: usize = 64;
        let (mut part, mut from) = (PART, start.clone());
        for _ in 0..MOST_ROUNDS {
            if part < LEAST_PART || !nearest.distance.is_finite() {
                break;
            }
            // A redundant arm has a manifold of solutions. Moving towards `start` departs from it, and solving returns to it at a nearby
            // point: a projected descent of the distance.
            for ((from, start), found) in from.iter_mut().zip(start).zip(&nearest.q) {
                *from = found + part * (start - found);
            }
            let converged = self.solve(target, &from, options, || true)?.converged;
            let distance = self.turn_towards(start);
            if converged && distance < nearest.distance * (1.0 - NEARER) {
                *nearest = NearestSolution { distance, q: self.solution().clone() };
            } else {
                part /= 2.0;
            }
        }
        Ok(())
    }
}
