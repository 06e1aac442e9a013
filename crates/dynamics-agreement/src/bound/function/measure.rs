//! The measure of a function with several values that is bounded: a length, a sum, or the largest torque of a motion.

use super::speeds::{Form, FormRange, SpeedInterval, gap};

/// A convex function of several values, so that its maximum over a hull is at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::bound) enum ValueMeasure {
    /// The Euclidean norm of the values.
    Length,
    /// The sum of the absolute values.
    Sum,
    /// The largest torque of any motion with these coefficients.
    Motion(MotionCoefficients),
}

/// The values are the gravity torque, the torque of each joint's largest acceleration, and the coefficients of the products
/// of speeds, which are shares of their limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::bound) struct MotionCoefficients {
    pub(in crate::bound) gravity: bool,
    pub(in crate::bound) accelerations: usize,
    pub(in crate::bound) speeds: usize,
    /// The largest torque of damping and dry friction, N m or N.
    pub(in crate::bound) resistance: f64,
}

/// An upper bound over a box of speeds.
#[derive(Debug, Clone, Copy)]
pub(in crate::bound) struct Upper {
    pub(in crate::bound) value: f64,
    /// The speed whose square makes the bound loose, and by how much; `None` if the bound is exact.
    pub(in crate::bound) loose: Option<(usize, f64)>,
}

/// The motion of the largest torque at some positions.
#[derive(Debug, Clone)]
pub(in crate::bound) struct LargestMotion {
    /// Speeds as shares of their limits.
    pub(in crate::bound) speeds: Vec<f64>,
    /// Accelerations as shares of their limits, -1 or 1 each.
    pub(in crate::bound) accelerations: Vec<f64>,
}

impl ValueMeasure {
    /// The measure of one vector of values.
    #[inline]
    pub(in crate::bound) fn value(self, values: &[f64]) -> f64 {
        match self {
            Self::Length => values.iter().map(|value| value * value).sum::<f64>().sqrt(),
            Self::Sum => values.iter().map(|value| value.abs()).sum(),
            Self::Motion(motion) => motion.largest_torque_above(values, f64::NEG_INFINITY),
        }
    }

    /// The measure if it exceeds `least`, otherwise a value that does not.
    pub(in crate::bound) fn value_above(self, values: &[f64], least: f64) -> f64 {
        match self {
            Self::Motion(motion) => motion.largest_torque_above(values, least),
            _ => self.value(values),
        }
    }

    /// An upper bound of the measure over a box of speeds.
    pub(in crate::bound) fn above(self, values: &[f64], speeds: &[SpeedInterval]) -> Upper {
        match self {
            Self::Motion(motion) => motion.above(values, speeds),
            _ => Upper { value: self.value(values), loose: None },
        }
    }

    /// A larger upper bound that is cheap to compute.
    #[inline]
    pub(in crate::bound) fn roughly_above(self, values: &[f64], speeds: &[SpeedInterval]) -> f64 {
        match self {
            Self::Motion(motion) => motion.roughly_above(values, speeds),
            _ => self.value(values),
        }
    }

    /// Number of speeds whose intervals may be halved.
    pub(in crate::bound) fn speeds(self) -> usize {
        if let Self::Motion(motion) = self { motion.speeds } else { 0 }
    }
}

impl MotionCoefficients {
    /// Splits the values into gravity, accelerations and products of speeds.
    #[inline]
    fn parts<'a>(&self, values: &'a [f64]) -> (f64, &'a [f64], Form<'a>) {
        let (gravity, rest) = values.split_at(usize::from(self.gravity));
        let (accelerations, coefficients) = rest.split_at(self.accelerations);
        let gravity = gravity.first().copied().unwrap_or(0.0);
        (gravity, accelerations, Form { coefficients, speeds: self.speeds })
    }

    /// The largest absolute torque over all speeds and accelerations within their limits if it exceeds `least`, otherwise a
    /// value that does not: most positions of a search are refused by the corners of the speeds alone.
    fn largest_torque_above(&self, values: &[f64], least: f64) -> f64 {
        let (gravity, accelerations, form) = self.parts(values);
        // Each acceleration takes the sign of its coefficient: absolute values add up.
        let pushed = accelerations.iter().map(|value| value.abs()).sum::<f64>() + self.resistance;
        let [up, down] = form.largest_above([least - gravity - pushed, least + gravity - pushed]);
        // The absolute value of gravity + products is largest at the top or at the bottom; accelerations and
        // resistance push whichever way that is.
        (gravity + up.0).max(down.0 - gravity) + pushed
    }

    /// The motion with the largest torque.
    pub(in crate::bound) fn largest(&self, values: &[f64]) -> LargestMotion {
        let (gravity, accelerations, form) = self.parts(values);
        let [up, down] = form.largest_above([f64::NEG_INFINITY; 2]);
        let (sign, speeds) = if gravity + up.0 >= down.0 - gravity { (1.0, up.1) } else { (-1.0, down.1) };
        LargestMotion {
            speeds: speeds[..self.speeds].to_vec(),
            // Accelerations must push the same way as gravity and products, otherwise the motion would not attain
            // the sum.
            accelerations: accelerations.iter().map(|value| sign * value.signum()).collect(),
        }
    }

    fn above(&self, values: &[f64], intervals: &[SpeedInterval]) -> Upper {
        let (gravity, accelerations, form) = self.parts(values);
        let pushed = accelerations.iter().map(|value| value.abs()).sum::<f64>() + self.resistance;
        let FormRange { least, most, below, above } = form.range(intervals);
        let (up, down) = (gravity + most + above, below - gravity - least);
        let sign = if up >= down { 1.0 } else { -1.0 };
        // A square that is convex towards the bound is largest at a corner; only a concave one can exceed the
        // corners, by its gap. Halving that speed tightens the bound most.
        let looseness = |j: usize| (-sign * form.square(j)).max(0.0) * gap(&intervals[j]);
        let loose = (0..self.speeds)
            .map(|j| (j, looseness(j)))
            .filter(|(_, by)| *by > 0.0)
            .max_by(|a, b| a.1.total_cmp(&b.1));
        Upper { value: up.max(down) + pushed, loose }
    }

    #[inline]
    fn roughly_above(&self, values: &[f64], intervals: &[SpeedInterval]) -> f64 {
        let (gravity, accelerations, form) = self.parts(values);
        let pushed = accelerations.iter().map(|value| value.abs()).sum::<f64>() + self.resistance;
        let [up, down] = form.rough_range(intervals);
        (gravity + up).max(down - gravity) + pushed
    }
}
