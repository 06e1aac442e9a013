//! Sums of sines that begin and end at rest.

use std::f64::consts::TAU;

use congruent_description::RobotQ;

/// Harmonics of each joint. Kind: choice, as in the literature.
pub(crate) const HARMONICS: usize = 5;
/// The part of the duration in which the motion swells, and that in which it fades. No unit; kind: choice.
const SWELL: f64 = 0.1;

/// A motion of the driven joints about a configuration: `q = center + s(t) sum_l (a_l sin l w t + b_l cos l w t) / l`, where `s` rises
/// from rest and ends there.
#[derive(Debug, Clone, PartialEq)]
pub struct FourierMotion {
    /// Where it begins and ends, rad or m.
    pub center: RobotQ,
    /// How long it takes, s.
    pub duration_s: f64,
    /// The moving joints that it moves.
    pub joints: Vec<usize>,
    /// For each of these the factors of the sines and of the cosines, rad or m.
    pub factors: Vec<[[f64; 2]; HARMONICS]>,
}

impl FourierMotion {
    /// Positions, velocities and accelerations at a time, of all moving joints; those that it does not move stay.
    pub fn state_into(&self, time_s: f64, q: &mut RobotQ, qd: &mut [f64], qdd: &mut [f64]) {
        q.copy_from_slice(&self.center);
        qd.fill(0.0);
        qdd.fill(0.0);
        let [s, ds, dds] = swell(time_s, self.duration_s);
        for (&joint, factors) in self.joints.iter().zip(&self.factors) {
            let [f, df, ddf] = self.sum(factors, time_s);
            q[joint] += s * f;
            qd[joint] = ds * f + s * df;
            qdd[joint] = dds * f + 2.0 * ds * df + s * ddf;
        }
    }

    /// A sum of sines with its two derivatives.
    fn sum(&self, factors: &[[f64; 2]; HARMONICS], time_s: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let mut order = 0.0;
        for [of_sine, of_cosine] in factors {
            order += 1.0;
            let rate = order * TAU / self.duration_s * ROUNDS;
            let (sine, cosine) = (libm::sin(rate * time_s), libm::cos(rate * time_s));
            sum[0] += (of_sine * sine + of_cosine * cosine) / order;
            sum[1] += rate * (of_sine * cosine - of_cosine * sine) / order;
            sum[2] -= rate * rate * (of_sine * sine + of_cosine * cosine) / order;
        }
        sum
    }
}

/// Periods of the slowest sine in the duration. Kind: choice; with ten seconds, the fastest sine has 1 Hz.
const ROUNDS: f64 = 2.0;

/// From 0 at the beginning to 1 and back to 0 at the end, with two derivatives that are zero there.
fn swell(time_s: f64, duration_s: f64) -> [f64; 3] {
    let length_s = SWELL * duration_s;
    let left_s = duration_s - time_s;
    let (x, sign) = if time_s < length_s {
        (time_s / length_s, 1.0)
    } else if left_s < length_s {
        (left_s.max(0.0) / length_s, -1.0)
    } else {
        return [1.0, 0.0, 0.0];
    };
    // The polynomial of the fifth degree from rest to rest.
    let value = x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    let first = 30.0 * x * x * (1.0 - x) * (1.0 - x) / length_s;
    let second = 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / (length_s * length_s);
    [value, sign * first, second]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> FourierMotion {
        let factors = [[0.3, 0.1], [-0.2, 0.4], [0.1, 0.0], [0.05, -0.3], [0.2, 0.1]];
        FourierMotion { center: vec![0.5].into(), duration_s: 10.0, joints: vec![0], factors: vec![factors] }
    }

    #[test]
    fn it_begins_and_ends_at_rest_and_its_derivatives_are_those_of_differences() {
        let state = |time_s: f64| {
            let (mut q, mut qd, mut qdd) = (RobotQ::from(vec![0.0]), vec![0.0], vec![0.0]);
            motion().state_into(time_s, &mut q, &mut qd, &mut qdd);
            [q[0], qd[0], qdd[0]]
        };
        for end_s in [0.0, 10.0] {
            let [q, qd, qdd] = state(end_s);
            assert!((q - 0.5).abs() < 1e-12 && qd.abs() < 1e-12 && qdd.abs() < 1e-9, "{end_s}");
        }
        for time_s in [0.3, 0.99, 4.7, 9.2, 9.9] {
            let step_s = 1e-5;
            let [before, here, after] = [time_s - step_s, time_s, time_s + step_s].map(state);
            let change = |of: usize| (after[of] - before[of]) / (2.0 * step_s);
            assert!((change(0) - here[1]).abs() < 1e-7 && (change(1) - here[2]).abs() < 1e-6, "{time_s}");
        }
    }
}
