//! Wrenches: moment and force on a rigid body, the duals of twists. Their 6 numbers are `adjoint.rs`.

use nalgebra::{Point3, Vector3};

use super::{pose::Pose, twist::Twist};

/// What acts on a body: moment and force, moment first as the turn comes first in a [`Twist`].
///
/// The frame is in the name of the value: `wrench_in_base` has the axes of the base, and its moment
/// is about the base's origin.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `moment` | 3 | N m, about the frame's origin | the named one |
/// | `force` | 3 | N | the named one |
///
/// Source: Lynch & Park, *Modern Robotics* (2017), section 3.4: `F = (m, f)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Moment about the frame's origin, N m.
    pub moment: Vector3<f64>,
    /// Force in the axes of the frame, N.
    pub force: Vector3<f64>,
}

impl Wrench {
    /// The zero wrench: no force and no moment.
    #[inline]
    pub fn zero() -> Self {
        Self { moment: Vector3::zeros(), force: Vector3::zeros() }
    }

    /// A force alone, in newtons, on a line through `point`: its moment is `point x force`.
    ///
    /// # Examples
    /// A weight of 10 N, 0.5 m out along x, turns about y.
    /// ```
    /// use congruent_kinematics::Wrench;
    /// use nalgebra::{Point3, Vector3};
    /// let weight_in_base = Wrench::force_at(Vector3::new(0., 0., -10.), &Point3::new(0.5, 0., 0.));
    /// assert_eq!(weight_in_base.moment, Vector3::new(0., 5., 0.));
    /// ```
    #[inline]
    pub fn force_at(force: Vector3<f64>, point: &Point3<f64>) -> Self {
        Self { moment: point.coords.cross(&force), force }
    }

    /// The same wrench in the frame that `a_from_b` leads to: `F_a = Ad(b_from_a)^T F_b`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), proposition 3.27: `f_a = R f_b`,
    /// `m_a = R m_b + p x R f_b`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, Wrench};
    /// use nalgebra::{Matrix3, Vector3};
    /// let push_in_tcp = Wrench { moment: Vector3::zeros(), force: Vector3::new(0., 2., 0.) };
    /// let base_from_tcp = Pose::from_parts(Matrix3::identity(), Vector3::new(3., 0., 0.));
    /// assert_eq!(push_in_tcp.transformed_by(&base_from_tcp).moment, Vector3::new(0., 0., 6.));
    /// ```
    #[must_use]
    pub fn transformed_by(&self, a_from_b: &Pose) -> Self {
        let force = a_from_b.rotation * self.force;
        Self { moment: a_from_b.rotation * self.moment + a_from_b.translation.cross(&force), force }
    }

    /// Power in watts that the wrench gives to a body that moves with `twist`, both in one frame;
    /// it is the same in every frame.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 3.4: `V^T F`.
    ///
    /// # Examples
    /// A crank of 0.5 m that is pushed sideways with 4 N at 3 rad/s.
    /// ```
    /// use congruent_kinematics::{Twist, Wrench};
    /// use nalgebra::{Point3, Vector3};
    /// let push = Wrench::force_at(Vector3::new(0., 4., 0.), &Point3::new(0.5, 0., 0.));
    /// let crank = Twist { angular: Vector3::new(0., 0., 3.), linear: Vector3::zeros() };
    /// assert_eq!(push.power(&crank), 6.0);
    /// ```
    #[inline]
    pub fn power(&self, twist: &Twist) -> f64 {
        self.moment.dot(&twist.angular) + self.force.dot(&twist.linear)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding of a dozen products of numbers up to 2; worst seen 1.4e-15.
    const ROUNDING: f64 = 1e-14;

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn power_is_the_same_in_every_frame(
            a_from_b in support::isometry(),
            [moment, force, angular, linear] in [support::vector(), support::vector(), support::vector(), support::vector()],
        ) {
            let (wrench, twist) = (Wrench { moment, force }, Twist { angular, linear });
            let a_from_b = Pose::from(a_from_b);
            let in_a = wrench.transformed_by(&a_from_b).power(&twist.transformed_by(&a_from_b));
            prop_assert!(support::within((in_a - wrench.power(&twist)).abs(), ROUNDING));
        }

        #[test]
        fn a_force_moves_with_its_point(
            a_from_b in support::isometry(), [force, point] in [support::vector(), support::vector()],
        ) {
            let a_from_b = Pose::from(a_from_b);
            let seen = Wrench::force_at(force, &Point3::from(point)).transformed_by(&a_from_b);
            let moved = Wrench::force_at(a_from_b.transform_vector(&force), &(a_from_b * Point3::from(point)));
            prop_assert!(support::within((seen.moment - moved.moment).norm(), ROUNDING));
            prop_assert_eq!(seen.force, moved.force);
        }
    }

    #[test]
    fn nothing_does_nothing() {
        let twist = Twist { angular: Vector3::x(), linear: Vector3::y() };
        assert_eq!(Wrench::zero().power(&twist).to_bits(), 0.0_f64.to_bits());
        assert_eq!(Wrench::zero(), Wrench::force_at(Vector3::zeros(), &Point3::new(1., 2., 3.)));
    }
}
