//! Twists and screws: the generators of rigid motions, with exponential and logarithm of SE(3).

use nalgebra::{Matrix3, Matrix4, Unit, Vector3};

use super::{
    pose::Pose,
    rotation::{half_versine_ratio, hat, rotation_log, sinc},
};

/// Below this angle the coefficients that cancel are summed as series. The first term left out
/// weighs 2e-16 of the sum there; above, cancellation costs less than `eps / angle^2` of a
/// coefficient that is multiplied by `angle^2`.
pub(crate) const SERIES_BELOW_RAD: f64 = 0.25;

/// A generator of rigid motions, or a velocity: turning and shifting, angular first.
///
/// The frame is in the name of the value: `twist_in_root` moves points given in the root frame.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `angular` | 3 | rad per unit of the scalar | the named one |
/// | `linear` | 3 | m per unit of the scalar: motion of the point at the origin | the named one |
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Twist {
    /// Turn per unit of the scalar.
    pub angular: Vector3<f64>,
    /// Shift of the point at the frame's origin per unit of the scalar.
    pub linear: Vector3<f64>,
}

impl Twist {
    /// The zero twist: no motion.
    #[inline]
    pub fn zero() -> Self {
        Self { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }

    /// The 4 x 4 matrix `[V]` whose matrix exponential is the motion.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 3.3.2.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Twist;
    /// use nalgebra::{Matrix4, Vector3};
    /// let twist = Twist { angular: Vector3::new(1., 2., 3.), linear: Vector3::new(4., 5., 6.) };
    /// let rows = [[0., -3., 2., 4.], [3., 0., -1., 5.], [-2., 1., 0., 6.], [0.; 4]];
    /// assert_eq!(twist.hat(), Matrix4::from_row_slice(rows.as_flattened()));
    /// ```
    pub fn hat(&self) -> Matrix4<f64> {
        let mut matrix = Matrix4::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&hat(&self.angular));
        matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&self.linear);
        matrix
    }

    /// The motion after following the twist for `scalar` units: `exp([V] scalar)`.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `scalar` | 1 | that of the twist (1, s, rad or m) | |
    /// | result | SE(3) | m | that of the twist |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), proposition 3.25, eq. 3.88.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Twist;
    /// use nalgebra::Vector3;
    /// let shift = Twist { angular: Vector3::zeros(), linear: Vector3::new(1., 2., 3.) };
    /// assert_eq!(shift.exp(2.0).translation, Vector3::new(2., 4., 6.));
    /// // A turn about the vertical axis through (1, 0, 0) carries the origin along a circle to (2, 0, 0).
    /// let turn = Twist { angular: Vector3::z(), linear: Vector3::new(0., -1., 0.) };
    /// let half_turn = turn.exp(std::f64::consts::PI);
    /// assert!((half_turn.translation - Vector3::new(2., 0., 0.)).norm() < 4.0 * f64::EPSILON);
    /// ```
    pub fn exp(&self, scalar: f64) -> Pose {
        let (turn, shift) = (self.angular * scalar, self.linear * scalar);
        let angle = turn.norm();
        let skew = hat(&turn);
        let skew_skew = skew * skew;
        let half_versine = half_versine_ratio(angle);
        let rotation = Matrix3::identity() + skew * sinc(angle) + skew_skew * half_versine;
        let left = Matrix3::identity() + skew * half_versine + skew_skew * sine_lag_ratio(angle);
        Pose::from_parts(rotation, left * shift)
    }

    /// The same motion in the frame that `a_from_b` leads to: `V_a = Ad(a_from_b) V_b`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), definition 3.20: `w_a = R w_b`,
    /// `v_a = p x R w_b + R v_b`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, Twist};
    /// use nalgebra::{Matrix3, Vector3};
    /// let turn_in_body = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
    /// let space_from_body = Pose::from_parts(Matrix3::identity(), Vector3::new(1., 0., 0.));
    /// assert_eq!(turn_in_body.transformed_by(&space_from_body).linear, Vector3::new(0., -1., 0.));
    /// ```
    #[must_use]
    pub fn transformed_by(&self, a_from_b: &Pose) -> Self {
        let angular = a_from_b.rotation * self.angular;
        let linear = a_from_b.translation.cross(&angular) + a_from_b.rotation * self.linear;
        Self { angular, linear }
    }

    /// The twist that makes a motion within one unit, its turn in `0..=pi`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 3.3.3.2; the inverse of the left
    /// factor as `I - [w]/2 + (1/t^2 - cot(t/2)/(2 t)) [w]^2`, `t = |w|`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Twist;
    /// use nalgebra::Vector3;
    /// let twist = Twist { angular: Vector3::new(0.3, -0.2, 0.1), linear: Vector3::new(1., 2., 3.) };
    /// let back = Twist::log(&twist.exp(1.0));
    /// assert!((back.angular - twist.angular).norm() < 4.0 * f64::EPSILON);
    /// assert!((back.linear - twist.linear).norm() < 16.0 * f64::EPSILON);
    /// ```
    pub fn log(motion: &Pose) -> Self {
        let angular = rotation_log(&motion.rotation);
        let about = |v: &Vector3<f64>| angular.cross(v);
        let (shift, once) = (motion.translation, about(&motion.translation));
        let linear = shift - once / 2.0 + about(&once) * log_ratio(angular.norm());
        Self { angular, linear }
    }
}

/// The motion of one joint as a unit screw: a turn about a line, or a shift along a direction.
///
/// What the exponential needs is computed once, and both of its forms are exact: the lag of the
/// sine that a general twist needs does not occur without pitch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screw {
    twist: Twist,
    angular_hat: Matrix3<f64>,
    angular_hat_squared: Matrix3<f64>,
    angular_cross_linear: Vector3<f64>,
}

impl Screw {
    /// The turn about the line through `point` along `axis`; its coordinate is in radians.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 3.3.2.2: `v = -w x point`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Screw;
    /// use nalgebra::{Point3, Vector3};
    /// let screw = Screw::revolute(Vector3::z_axis(), &Point3::new(1., 0., 0.));
    /// assert_eq!(screw.twist().linear, Vector3::new(0., -1., 0.));
    /// ```
    pub fn revolute(axis: Unit<Vector3<f64>>, point: &nalgebra::Point3<f64>) -> Self {
        let (angular, linear) = (axis.into_inner(), -axis.cross(&point.coords));
        let angular_hat = hat(&angular);
        Self {
            twist: Twist { angular, linear },
            angular_hat,
            angular_hat_squared: angular_hat * angular_hat,
            angular_cross_linear: angular.cross(&linear),
        }
    }

    /// The shift along `axis`; its coordinate is in metres.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Screw;
    /// use nalgebra::Vector3;
    /// assert_eq!(Screw::prismatic(Vector3::z_axis()).exp(0.3).translation, Vector3::new(0., 0., 0.3));
    /// ```
    pub fn prismatic(axis: Unit<Vector3<f64>>) -> Self {
        Self {
            twist: Twist { angular: Vector3::zeros(), linear: axis.into_inner() },
            angular_hat: Matrix3::zeros(),
            angular_hat_squared: Matrix3::zeros(),
            angular_cross_linear: Vector3::zeros(),
        }
    }

    /// The generator: one unit of the coordinate along it.
    pub fn twist(&self) -> Twist {
        self.twist
    }

    /// Whether the screw turns; otherwise it shifts.
    #[inline]
    pub fn is_revolute(&self) -> bool {
        self.twist.angular != Vector3::zeros()
    }

    /// The motion at joint coordinate `q` (rad or m): [`Twist::exp`] without its general terms.
    ///
    /// For a unit screw without pitch the shift is `sin(q) v + (1 - cos(q)) w x v`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, Screw};
    /// use nalgebra::{Point3, Vector3};
    /// let screw = Screw::revolute(Vector3::z_axis(), &Point3::new(1., 0., 0.));
    /// assert_eq!(screw.exp(0.0), Pose::identity());
    /// assert!(screw.exp(0.7).distance_m(&screw.twist().exp(0.7)) < 4.0 * f64::EPSILON);
    /// ```
    #[inline]
    pub fn exp(&self, q: f64) -> Pose {
        if !self.is_revolute() {
            return Pose::from_parts(Matrix3::identity(), self.twist.linear * q);
        }
        let (sin, cos) = libm::sincos(q);
        let versine = 1.0 - cos;
        Pose {
            rotation: Matrix3::identity() + self.angular_hat * sin + self.angular_hat_squared * versine,
            translation: self.twist.linear * sin + self.angular_cross_linear * versine,
        }
    }
}

/// `(x - sin x) / x^3`, 1/6 at 0.
pub(crate) fn sine_lag_ratio(x: f64) -> f64 {
    let xx = x * x;
    if x < SERIES_BELOW_RAD {
        let tail = 1.0 / 362_880.0 - xx / 39_916_800.0;
        1.0 / 6.0 - xx * (1.0 / 120.0 - xx * (1.0 / 5040.0 - xx * tail))
    } else {
        (x - libm::sin(x)) / (xx * x)
    }
}

/// `(1 - (x/2) cot(x/2)) / x^2`, 1/12 at 0.
pub fn log_ratio(x: f64) -> f64 {
    let xx = x * x;
    if x < SERIES_BELOW_RAD {
        let tail = 1.0 / 1_209_600.0 + xx / 47_900_160.0;
        1.0 / 12.0 + xx * (1.0 / 720.0 + xx * (1.0 / 30_240.0 + xx * tail))
    } else {
        let half = x / 2.0;
        (1.0 - half * libm::cos(half) / libm::sin(half)) / xx
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use nalgebra::Point3;
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding: some twenty operations on numbers up to 10 (pi times 3 m); worst seen 2.1e-15.
    const ROUNDING_M: f64 = 2e-14;
    /// Rounding of a dozen operations on numbers up to pi; worst seen 1.1e-15.
    const ROUNDING_RAD: f64 = 1e-14;

    fn twist(angular: Vector3<f64>) -> Twist {
        Twist { angular, linear: Vector3::new(1.5, -2.0, 1.0) }
    }

    #[track_caller]
    fn assert_round_trip(twist: Twist) {
        let back = Twist::log(&twist.exp(1.0));
        assert!(
            support::within((back.angular - twist.angular).norm(), ROUNDING_RAD),
            "{back:?} for {twist:?}"
        );
        assert!(support::within((back.linear - twist.linear).norm(), ROUNDING_M), "{back:?} for {twist:?}");
    }

    #[test]
    fn log_undoes_exp_at_the_ends_of_the_range() {
        let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let around_series = [SERIES_BELOW_RAD - 1e-9, SERIES_BELOW_RAD, SERIES_BELOW_RAD + 1e-9];
        for angle in [0.0, 1e-200, 1e-16, 1e-12, 1e-8, 1e-4, 1e-3, 1.0, PI - 1e-4, PI - 1e-9, PI - 1e-14] {
            assert_round_trip(twist(axis * angle));
        }
        for angle in around_series {
            assert_round_trip(twist(axis * angle));
        }
    }

    /// At pi itself the turn may come back about the opposite axis: the motion is what counts.
    #[test]
    fn exp_undoes_log_at_pi() {
        for axis in [Vector3::x(), -Vector3::y(), Vector3::z(), Vector3::new(-2.0, 1.0, -2.0) / 3.0] {
            let half_turn = twist(axis * PI).exp(1.0);
            let found = Twist::log(&half_turn);
            assert!(support::within((found.angular.norm() - PI).abs(), ROUNDING_RAD));
            let back = found.exp(1.0);
            assert!(support::within(back.angle_rad(&half_turn), ROUNDING_RAD));
            assert!(support::within(back.distance_m(&half_turn), ROUNDING_M));
        }
    }

    #[test]
    fn series_meet_the_closed_forms() {
        /// Rounding of the closed form just above the switch: eps / 0.25^2; worst seen 1.5e-15.
        const CANCELLATION: f64 = 4e-15;
        let (below, above) = (SERIES_BELOW_RAD.next_down(), SERIES_BELOW_RAD);
        assert!(support::within((sine_lag_ratio(below) - sine_lag_ratio(above)).abs(), CANCELLATION));
        assert!(support::within((log_ratio(below) - log_ratio(above)).abs(), CANCELLATION));
    }

    #[test]
    fn exp_is_the_matrix_exponential() {
        let twist = twist(Vector3::new(0.4, -0.7, 1.1));
        let by_series = twist.hat().exp();
        let pose = twist.exp(1.0);
        let difference = by_series.fixed_view::<3, 3>(0, 0) - pose.rotation;
        assert!(support::within(difference.norm(), ROUNDING_RAD));
        assert!(support::within((by_series.fixed_view::<3, 1>(0, 3) - pose.translation).norm(), ROUNDING_M));
    }

    #[test]
    fn a_prismatic_screw_only_shifts() {
        let screw = Screw::prismatic(Vector3::y_axis());
        assert!(!screw.is_revolute());
        assert_eq!(screw.exp(-0.3), Pose::from_parts(Matrix3::identity(), Vector3::new(0., -0.3, 0.)));
        assert_eq!(screw.exp(-0.3), screw.twist().exp(-0.3));
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn log_undoes_exp(axis in support::unit_vector(), linear in support::vector(), angle in 0.0..PI) {
            let twist = Twist { angular: axis.into_inner() * angle, linear };
            let back = Twist::log(&twist.exp(1.0));
            prop_assert!(support::within((back.angular - twist.angular).norm(), ROUNDING_RAD));
            prop_assert!(support::within((back.linear - linear).norm(), ROUNDING_M));
        }

        #[test]
        fn exp_undoes_log_near_pi(motion in support::isometry(), exponent in -14.0..-1.0) {
            let axis = motion.rotation * Vector3::x();
            let near_pi = crate::spatial::rotation::rotation_exp(&(axis * (PI - 10_f64.powf(exponent))));
            let pose = Pose::from_parts(near_pi, motion.translation.vector);
            let back = Twist::log(&pose).exp(1.0);
            prop_assert!(support::within(back.angle_rad(&pose), ROUNDING_RAD));
            prop_assert!(support::within(back.distance_m(&pose), ROUNDING_M));
        }

        #[test]
        fn log_undoes_exp_near_zero(axis in support::unit_vector(), linear in support::vector(), exponent in -30.0..0.0) {
            let twist = Twist { angular: axis.into_inner() * 10_f64.powf(exponent), linear };
            let back = Twist::log(&twist.exp(1.0));
            prop_assert!(support::within((back.angular - twist.angular).norm(), ROUNDING_RAD * twist.angular.norm()));
            prop_assert!(support::within((back.linear - linear).norm(), ROUNDING_M));
        }

        #[test]
        fn a_screw_is_its_twist(axis in support::unit_vector(), point in support::vector(), q in -PI..PI) {
            for screw in [Screw::revolute(axis, &Point3::from(point)), Screw::prismatic(axis)] {
                let (exact, general) = (screw.exp(q), screw.twist().exp(q));
                prop_assert!(support::within(exact.angle_rad(&general), ROUNDING_RAD));
                prop_assert!(support::within(exact.distance_m(&general), ROUNDING_M));
            }
        }
    }
}
