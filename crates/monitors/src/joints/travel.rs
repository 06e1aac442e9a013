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
    joints: Vec<JointTravel>,
}

/// The positions of one joint so far.
#[derive(Clone, Copy)]
struct JointTravel {
    commanded: TravelRange,
    made: TravelRange,
    together: Covariance,
}

impl JointTravel {
    const NONE: Self =
        Self { commanded: TravelRange::EMPTY, made: TravelRange::EMPTY, together: Covariance::NONE };

    fn take(&mut self, commanded: f64, made: f64) {
        self.commanded.take(commanded);
        self.made.take(made);
        self.together.take([commanded, made]);
    }

    /// The part of the commanded travel that is made; `None` if the joint is not judged.
    fn share(&self) -> Option<f64> {
        let share = self.made.length() / self.commanded.length();
        let signed = if self.together.sum < 0.0 { -share } else { share };
        (self.commanded.length() > SMALLEST_TRAVEL).then_some(signed)
    }
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
#[derive(Clone, Copy)]
struct Covariance {
    samples: f64,
    means: [f64; 2],
    sum: f64,
}

impl Covariance {
    const NONE: Self = Self { samples: 0.0, means: [0.0; 2], sum: 0.0 };

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
            joints: vec![JointTravel::NONE; dof],
        }
    }

    /// Takes the setpoint and the positions of a sample; the shares are known at the end of the run.
    pub(super) fn observe(&mut self, setpoint: &RobotQ, sample: &Sample<'_>) {
        let positions = setpoint.iter().zip(sample.joints.state().q.iter());
        for (joint, (&commanded, &made)) in self.joints.iter_mut().zip(positions) {
            joint.take(commanded, made);
        }
        // In the middle of a motion every servo is behind: nothing follows from a run that ends there.
        let is_cut_short = sample.time_s < sample.motions_s - ROUNDING_S;
        if !sample.is_last || is_cut_short {
            return;
        }
        for (index, joint) in self.joints.iter().enumerate() {
            if let Some(share) = joint.share() {
                self.watch.observe(share, index, sample);
            }
        }
    }
}
