//! The sensors of the joints: from the positions of the encoders to the readings, stage after stage.

use std::f64::consts::TAU;

use congruent_description::RobotQ;
use congruent_simulation::MeasuredState;
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use crate::{
    random_streams::SENSORS,
    setup::{RunSetup, SensorSetup},
};

/// The sensors of all joints with their last reading.
#[derive(Debug, Clone)]
pub(super) struct JointSensors {
    setup: SensorSetup,
    step_s: f64,
    random: ChaCha8Rng,
    q: RobotQ,
    qd: Vec<f64>,
    /// The reading before the last.
    before_q: RobotQ,
    is_first: bool,
}

impl JointSensors {
    pub(super) fn new(setup: &RunSetup) -> Self {
        let dof = setup.description.robot.dof();
        let mut random = ChaCha8Rng::seed_from_u64(setup.scenario.seed);
        random.set_stream(SENSORS);
        Self {
            setup: setup.sensors.clone(),
            step_s: setup.clock.step_s,
            random,
            q: RobotQ::zeros(dof),
            qd: vec![0.0; dof],
            before_q: RobotQ::zeros(dof),
            is_first: true,
        }
    }

    /// Reads the encoders: noise first, since an encoder quantises the noisy position, and velocities last, since a controller
    /// differentiates the quantised reading.
    pub(super) fn read(&mut self, q: &RobotQ, qd: &[f64]) {
        self.before_q.copy_from_slice(&self.q);
        self.q.copy_from_slice(q);
        self.qd.copy_from_slice(qd);
        // As in an encoder: noise is on the signal, counting comes after it, and differences are of what was counted.
        self.add_noise();
        self.round();
        self.differentiate();
        self.is_first = false;
    }

    /// The last reading of all joints.
    pub(super) fn measured(&self) -> MeasuredState<'_> {
        MeasuredState { q: &self.q, qd: &self.qd }
    }

    fn add_noise(&mut self) {
        for (joint, encoder) in self.setup.encoders.iter().enumerate() {
            if encoder.noise > 0.0 {
                self.q[joint] += encoder.noise * normal(&mut self.random);
            }
            if encoder.velocity_noise > 0.0 {
                self.qd[joint] += encoder.velocity_noise * normal(&mut self.random);
            }
        }
    }

    fn round(&mut self) {
        for (q, encoder) in self.q.iter_mut().zip(&self.setup.encoders) {
            if encoder.resolution > 0.0 {
                *q = (*q / encoder.resolution).round() * encoder.resolution;
            }
        }
    }

    fn differentiate(&mut self) {
        if !self.setup.differentiates {
            return;
        }
        for (qd, (q, before)) in self.qd.iter_mut().zip(self.q.iter().zip(&self.before_q)) {
            // Before the first reading the robot rests.
            *qd = if self.is_first { 0.0 } else { (q - before) / self.step_s };
        }
    }
}

/// A normally distributed number of variance 1, by Box and Muller's transform.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "the upper 53 bits fit")]
    let mut uniform = || ((random.next_u64() >> 11) as f64 + 0.5) / 2.0_f64.powi(53);
    // Half a unit of 2^-53 above zero, so that the logarithm is finite.
    let (radius, turn) = ((-2.0 * libm::log(uniform())).sqrt(), TAU * uniform());
    radius * libm::cos(turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_numbers_have_mean_zero_and_variance_one() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let count = 100_000;
        let numbers: Vec<f64> = (0..count).map(|_| normal(&mut random)).collect();
        let mean = |power| numbers.iter().map(|number| number.powi(power)).sum::<f64>() / f64::from(count);
        // Five standard errors of each moment: 1, sqrt(2) and sqrt(96) over sqrt(count).
        assert!(mean(1).abs() < 0.016 && (mean(2) - 1.0).abs() < 0.023, "{} {}", mean(1), mean(2));
        assert!((mean(4) - 3.0).abs() < 0.16, "{}", mean(4));
    }
}
