//! Seeded random states at which torques are compared.

use congruent_description::RobotQ;
use congruent_kinematics::Uniform;

use crate::{
    model::Frames,
    thresholds::{LARGEST_ACCELERATION, LARGEST_SPEED, SMALLEST_SPEED},
};

/// Positions, speeds and accelerations of all moving joints, mimic joints independent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SampledState {
    /// Positions, rad or m.
    pub(crate) q: RobotQ,
    /// Speeds, rad/s or m/s; at least `SMALLEST_SPEED` in size.
    pub(crate) qd: Vec<f64>,
    /// Accelerations, rad/s^2 or m/s^2.
    pub(crate) qdd: Vec<f64>,
}

/// A speed of either sign between `SMALLEST_SPEED` and `LARGEST_SPEED`.
fn speed(random: &mut Uniform) -> f64 {
    let signed = random.between(-1.0, 1.0);
    // Sign and size from one draw: uniform over both directions, without the interval around zero.
    signed.signum() * (SMALLEST_SPEED + (LARGEST_SPEED - SMALLEST_SPEED) * signed.abs())
}

/// Random positions of all joints within their limits.
pub(crate) fn position(random: &mut Uniform, frames: &Frames) -> RobotQ {
    frames.joints.iter().map(|joint| random.between(joint.range.0, joint.range.1)).collect()
}

/// Random states within the limits of positions: speeds are never near zero, where dry friction is undefined.
pub(crate) fn random_states(frames: &Frames, seed: u64, count: usize) -> Vec<SampledState> {
    let mut random = Uniform::seeded(seed);
    let mut state = || SampledState {
        q: position(&mut random, frames),
        qd: (0..frames.dof()).map(|_| speed(&mut random)).collect(),
        qdd: (0..frames.dof()).map(|_| random.between(-LARGEST_ACCELERATION, LARGEST_ACCELERATION)).collect(),
    };
    (0..count).map(|_| state()).collect()
}
