//! Faults between encoders and controller: readings that arrive late or not at all.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use super::encoders::Reading;

/// Readings of the last steps, the oldest first to leave; allocated once.
#[derive(Debug, Clone)]
pub(super) struct Delay {
    last: Vec<Reading>,
    next: usize,
    is_empty: bool,
}

impl Delay {
    /// A delay by a number of steps, without a reading so far.
    pub(super) fn new(steps: usize, dof: usize) -> Self {
        // One more than the delay: the ring holds the present reading as well.
        Self { last: vec![Reading::new(dof); steps + 1], next: 0, is_empty: true }
    }

    /// Takes a reading. This goes on without a fault too: what arrives late has been sent before.
    pub(super) fn take(&mut self, reading: &Reading) {
        if std::mem::take(&mut self.is_empty) {
            // Before the first reading the robot stood where that shows it.
            self.last.iter_mut().for_each(|last| last.copy_from(reading));
        }
        self.last[self.next].copy_from(reading);
        self.next = (self.next + 1) % self.last.len();
    }

    /// The reading that arrives now.
    pub(super) fn late(&self) -> &Reading {
        // `take` has moved on, so this is the oldest: that of `steps` ago.
        &self.last[self.next]
    }
}

/// Decides which readings get lost.
#[derive(Debug, Clone)]
pub(super) struct ReadingLoss {
    share: f64,
    generator: ChaCha8Rng,
}

impl ReadingLoss {
    /// `stream` distinguishes the faults of one scenario.
    pub(super) fn new(share: f64, seed: u64, stream: u64) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(stream);
        Self { share, generator }
    }

    /// Whether the reading of this instant gets lost.
    #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub(super) fn is_lost(&mut self) -> bool {
        const BITS: u32 = f64::MANTISSA_DIGITS;
        // All 53 bits of the mantissa: uniform in [0, 1), the same on every machine.
        let uniform = (self.generator.next_u64() >> (u64::BITS - BITS)) as f64 / (1_u64 << BITS) as f64;
        uniform < self.share
    }
}
