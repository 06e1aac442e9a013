//! The travel of each joint against the travel that its setpoint commands: a motion that nobody follows, however small.

use congruent_description::RobotQ;
use congruent_input::{Quantity, SiUnit};

use crate::{sample::Sample, verdict::Bound, watch::Watch};

/// A joint whose setpoint moves by less is not judged, rad and m. Kind: engineering; within it an arm counts as being at its
/// goal (`cycle_time`).
const SMALLEST_TRAVEL: f64 = 1e-3;
/// A run that ends this much before its motions is not cut short, s. Kind: rounding of a number of steps.
const ROUNDING_S: f64 = 1e-9;

/// The smallest part of its commanded travel that a joint makes, between the first and the last sample of a run.
///
/// Travel is the distance between the least and the largest position, so that neither lag nor sag of a servo counts; it is negative if
/// the joint goes the other way.
pub(super) struct TravelShare {
    pub(super) watch: Watch,
    commanded: Vec<TravelRange>,
    made: Vec<TravelRange>,
    together: Vec<Covariance>,
}

/// The least and the largest of some positions; NaN once one of them was.
#[derive(Clone, Copy)]
struct TravelRange {
    least: f64,
    largest: f64,
}

impl TravelRange {
    const EMPTY: Self = Self { least: f64::INFINITY, largest: f64::NEG_INFINITY };

    fn take(&mut self, position: f64) {
        // Not `min` and `max`, which drop a NaN.
        if position < self.least || position.is_nan() {
            self.least = position;
        }
        if position > self.largest {
            self.largest = position;
        }
    }

    fn length(self) -> f64 {
        self.largest - self.least
    }
}

/// Whether two quantities grow together: their covariance over the samples so far, times their number (Welford 1962).
#[derive(Clone, Copy, Default)]
struct Covariance {
    samples: f64,
    means: [f64; 2],
    sum: f64,
}

impl Covariance {
    fn take(&mut self, [a, b]: [f64; 2]) {
        self.samples += 1.0;
        let from_mean = a - self.means[0];
        self.means[0] += from_mean / self.samples;
        self.means[1] += (b - self.means[1]) / self.samples;
        self.sum += from_mean * (b - self.means[1]);
    }
}

impl TravelShare {
    pub(super) fn new(limit: f64, dof: usize) -> Self {
        Self {
            watch: Watch::new(Quantity::ShareOfTravel, SiUnit::Ratio, Bound::AtLeast, limit, dof),
            commanded: vec![TravelRange::EMPTY; dof],
            made: vec![TravelRange::EMPTY; dof],
            together: vec![Covariance::default(); dof],
        }
    }

    /// Takes the setpoint and the positions of a sample; the shares are known at the end of the run.
    pub(super) fn observe(&mut self, setpoint: &RobotQ, sample: &Sample<'_>) {
        for (commanded, &position) in self.commanded.iter_mut().zip(setpoint.iter()) {
            commanded.take(position);
        }
        for (made, &position) in self.made.iter_mut().zip(sample.joints.truth.q.iter()) {
            made.take(position);
        }
        for (together, of) in self.together.iter_mut().zip(setpoint.iter().zip(sample.joints.truth.q.iter()))
        {
            together.take([*of.0, *of.1]);
        }
        // In the middle of a motion every servo is behind: nothing follows from a run that ends there.
        let is_cut_short = sample.time_s < sample.motions_s - ROUNDING_S;
        if !sample.is_last || is_cut_short {
            return;
        }
        for (joint, (commanded, made)) in self.commanded.iter().zip(&self.made).enumerate() {
            if commanded.length() > SMALLEST_TRAVEL {
                let share = made.length() / commanded.length();
                let is_opposite = self.together[joint].sum < 0.0;
                self.watch.observe(if is_opposite { -share } else { share }, joint, sample);
            }
        }
    }
}
