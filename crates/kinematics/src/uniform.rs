//! Seeded random numbers: the same on every machine, and only where a caller gives the seed.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

/// Draws uniformly distributed numbers from an interval.
#[derive(Debug, Clone)]
pub struct Uniform(ChaCha8Rng);

impl Uniform {
    /// A generator that gives the same numbers for the same seed.
    pub fn seeded(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// A number in `lower..upper`, with 53 random bits.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub fn between(&mut self, lower: f64, upper: f64) -> f64 {
        let share = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        lower + (upper - lower) * share
    }
}
