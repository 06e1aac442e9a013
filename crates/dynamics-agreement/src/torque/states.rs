//! Seeded random states at which torques are compared.

use congruent_description::RobotQ;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use crate::{
    side::Frames,
    thresholds::{LARGEST_ACCELERATION, LARGEST_SPEED, SMALLEST_SPEED},
};

/// Positions, speeds and accelerations of all moving joints, mimic joints independent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct State {
    /// rad, m
    pub(crate) q: RobotQ,
    /// rad/s, m/s
    pub(crate) qd: Vec<f64>,
    /// rad/s^2, m/s^2
    pub(crate) qdd: Vec<f64>,
}

/// Draws numbers evenly from an interval.
pub(crate) struct Uniform(ChaCha8Rng);

impl Uniform {
    pub(crate) fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A number with 53 random bits.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub(crate) fn between(&mut self, (lower, upper): (f64, f64)) -> f64 {
        let share = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        lower + (upper - lower) * share
    }

    fn speed(&mut self) -> f64 {
        let signed = self.between((-1.0, 1.0));
        signed.signum() * (SMALLEST_SPEED + (LARGEST_SPEED - SMALLEST_SPEED) * signed.abs())
    }

    pub(crate) fn position(&mut self, frames: &Frames) -> RobotQ {
        frames.joints.iter().map(|joint| self.between(joint.range)).collect()
    }
}

/// Random states within the limits of positions: speeds are never near zero, where dry friction is undefined.
pub(crate) fn random_states(frames: &Frames, seed: u64, count: usize) -> Vec<State> {
    let mut random = Uniform::seeded(seed);
    let mut state = || State {
        q: random.position(frames),
        qd: (0..frames.dof()).map(|_| random.speed()).collect(),
        qdd: (0..frames.dof())
            .map(|_| random.between((-LARGEST_ACCELERATION, LARGEST_ACCELERATION)))
            .collect(),
    };
    (0..count).map(|_| state()).collect()
}
