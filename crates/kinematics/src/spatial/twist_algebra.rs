//! Twists as vectors: sums, multiples, and the derivative of the exponential. Their Lie bracket is in
//! `adjoint.rs`.

use std::ops::{Add, AddAssign, Mul};

use nalgebra::Vector3;

use super::{
    rotation::half_versine_ratio,
    twist::{SERIES_BELOW_RAD, Twist, sine_lag_ratio},
};

impl Add for Twist {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self { angular: self.angular + other.angular, linear: self.linear + other.linear }
    }
}

impl AddAssign for Twist {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Twist {
    type Output = Self;

    /// The twist that moves `factor` times as far.
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { angular: self.angular * factor, linear: self.linear * factor }
    }
}

impl Twist {
    /// A turn of 1 rad about the line through a point along a unit axis, both in the frame of the twist.
    #[inline]
    pub fn turn(axis: Vector3<f64>, point: &Vector3<f64>) -> Self {
        Self { angular: axis, linear: point.cross(&axis) }
    }

    /// A shift of 1 m along a unit axis.
    #[inline]
    pub fn shift(axis: Vector3<f64>) -> Self {
        Self { angular: Vector3::zeros(), linear: axis }
    }

    /// The six twists of which one component is 1: turns about x, y, z, then shifts along them.
    pub fn units() -> [Self; 6] {
        std::array::from_fn(|at| match at {
            0..3 => Self { angular: Vector3::ith(at, 1.0), linear: Vector3::zeros() },
            _ => Self::shift(Vector3::ith(at - 3, 1.0)),
        })
    }

    /// How the motion `exp([V])` moves when `V` changes at a rate: the twist `V'` with
    /// `d exp([V]) = [V'] exp([V])`.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `rate` | 6 | that of the twist | the same |
    /// | result | 6 | that of the twist | the same |
    ///
    /// It is `sum ad_V^k rate / (k + 1)!`, here by differentiating the closed form of
    /// [`Twist::exp`]; accurate at zero, and singular nowhere.
    ///
    /// Source: Hall, *Lie Groups, Lie Algebras, and Representations* (2nd edition, 2015), theorem 5.4,
    /// for a motion on the left.
    ///
    /// # Examples
    /// At zero the change itself; along the twist it commutes.
    /// ```
    /// use congruent_kinematics::Twist;
    /// use nalgebra::Vector3;
    /// let rate = Twist { angular: Vector3::new(0.3, -0.2, 0.1), linear: Vector3::new(1., 2., 3.) };
    /// assert_eq!(Twist::zero().dexp(&rate), rate);
    /// assert!((rate.dexp(&rate).linear - rate.linear).norm() < 8.0 * f64::EPSILON);
    /// ```
    #[must_use]
    pub fn dexp(&self, rate: &Self) -> Self {
        let (w, v, dw, dv) = (&self.angular, &self.linear, &rate.angular, &rate.linear);
        let angle = w.norm();
        let (versine, lag) = (half_versine_ratio(angle), sine_lag_ratio(angle));
        // shift = v + versine w x v + lag w x (w x v), and its derivative term by term.
        let once = w.cross(v);
        let twice = w.cross(&once);
        let shift = v + once * versine + twice * lag;
        let once_rate = dw.cross(v) + w.cross(dv);
        let twice_rate = dw.cross(&once) + w.cross(&once_rate);
        let by_angle = once * half_versine_slope(angle) + twice * sine_lag_slope(angle);
        let shift_rate = dv + once_rate * versine + twice_rate * lag + by_angle * w.dot(dw);
        let turned = w.cross(dw);
        let angular = dw + turned * versine + w.cross(&turned) * lag;
        // `shift_rate` is the velocity of the moved origin; a twist gives that of the point at the fixed one.
        Self { angular, linear: shift_rate - angular.cross(&shift) }
    }
}

/// `d((1 - cos x) / x^2) / (x dx)`, -1/12 at 0.
fn half_versine_slope(x: f64) -> f64 {
    let xx = x * x;
    if x < SERIES_BELOW_RAD {
        let tail = 1.0 / 453_600.0 - xx / 47_900_160.0;
        -1.0 / 12.0 + xx * (1.0 / 180.0 - xx * (1.0 / 6720.0 - xx * tail))
    } else {
        (libm::sin(x) / x - 2.0 * half_versine_ratio(x)) / xx
    }
}

/// `d((x - sin x) / x^3) / (x dx)`, -1/60 at 0.
fn sine_lag_slope(x: f64) -> f64 {
    let xx = x * x;
    if x < SERIES_BELOW_RAD {
        let tail = 1.0 / 4_989_600.0 - xx / 622_702_080.0;
        -1.0 / 60.0 + xx * (1.0 / 1260.0 - xx * (1.0 / 60_480.0 - xx * tail))
    } else {
        (half_versine_ratio(x) - 3.0 * sine_lag_ratio(x)) / xx
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding of the closed form and of a sum whose largest terms are 60 times the result, with
    /// twists of up to pi and 2 m; worst seen 2.4e-15.
    const ROUNDING: f64 = 2e-14;

    /// The sum that defines it, which needs no care at any angle within pi.
    fn by_series(twist: &Twist, rate: &Twist) -> Twist {
        let (mut term, mut sum) = (*rate, *rate);
        for order in 2..60 {
            term = twist.bracket(&term) * (1.0 / f64::from(order));
            sum += term;
        }
        sum
    }

    fn apart(a: &Twist, b: &Twist) -> f64 {
        (a.angular - b.angular).norm().max((a.linear - b.linear).norm())
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn the_closed_form_is_the_sum_at_every_angle(
            axis in support::unit_vector(), exponent in -30.0..0.5, linear in support::vector(),
            rate in [support::vector(), support::vector()],
        ) {
            let angle = 10_f64.powf(exponent);
            let twist = Twist { angular: axis.into_inner() * angle, linear };
            let rate = Twist { angular: rate[0], linear: rate[1] };
            let (found, expected) = (twist.dexp(&rate), by_series(&twist, &rate));
            prop_assert!(support::within(apart(&found, &expected), ROUNDING), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn both_sides_of_the_series_meet() {
        for angle in [0.0, 0.1, SERIES_BELOW_RAD.next_down(), SERIES_BELOW_RAD, 1.0, 3.1, 6.0] {
            let twist = Twist { angular: Vector3::new(2., -1., 2.) * (angle / 3.0), linear: Vector3::y() };
            for rate in Twist::units() {
                let (found, expected) = (twist.dexp(&rate), by_series(&twist, &rate));
                assert!(
                    support::within(apart(&found, &expected), ROUNDING),
                    "{angle}: {found:?} {expected:?}"
                );
            }
        }
    }
}
