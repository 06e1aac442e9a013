//! Twists and wrenches as six numbers, and the 6 x 6 matrices between them. Angular first, moment
//! first; this file is the only one that defines the order of six numbers.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::{pose::Pose, rotation::hat, twist::Twist, wrench::Wrench};

impl Pose {
    /// The matrix that takes a twist from frame b to frame a: `[[R, 0], [[p] R, R]]`.
    ///
    /// [`Twist::transformed_by`] does the same without a matrix. A wrench goes by the transpose of the
    /// inverse, as [`Wrench::transformed_by`] does.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | result | 6 x 6 | 1, m, 1/m | of `a_from_b`: twists of b in, twists of a out |
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), definition 3.20. Texts that write the linear
    /// part first have the block `[p] R` in the other corner.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Pose;
    /// let space_from_body = Pose::shift_x(1.0);
    /// let adjoint = space_from_body.adjoint();
    /// // A turn about the body's z shifts the point at the space's origin along -y.
    /// assert_eq!((adjoint[(4, 2)], adjoint[(2, 2)], adjoint[(2, 4)]), (-1.0, 1.0, 0.0));
    /// ```
    pub fn adjoint(&self) -> Matrix6<f64> {
        lower_triangle(&self.rotation, &(hat(&self.translation) * self.rotation))
    }
}

impl Twist {
    /// The Lie bracket `[V, W] = ad(V) W`: how `W` changes when it is carried along `V`.
    ///
    /// Its matrix [`Twist::hat`] is the commutator of theirs. A joint's twist changes at this rate while
    /// the joints before it move by `V`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 8.2.2.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Twist;
    /// use nalgebra::Vector3;
    /// let turn = Twist { angular: Vector3::z(), linear: Vector3::zeros() };
    /// let shift = Twist { angular: Vector3::zeros(), linear: Vector3::x() };
    /// assert_eq!(turn.bracket(&shift), Twist { angular: Vector3::zeros(), linear: Vector3::y() });
    /// ```
    #[inline]
    #[must_use]
    pub fn bracket(&self, other: &Self) -> Self {
        Self {
            angular: self.angular.cross(&other.angular),
            linear: self.linear.cross(&other.angular) + self.angular.cross(&other.linear),
        }
    }

    /// The matrix of [`Twist::bracket`], `ad(V) = [[[w], 0], [[v], [w]]]`, whose exponential is the
    /// adjoint of the motion: `exp(ad(V)) = Ad(exp([V]))`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), section 8.2.2.
    pub fn bracket_matrix(&self) -> Matrix6<f64> {
        lower_triangle(&hat(&self.angular), &hat(&self.linear))
    }
}

impl From<Twist> for Vector6<f64> {
    /// The twist as one vector `(angular, linear)`.
    #[inline]
    fn from(Twist { angular, linear }: Twist) -> Self {
        six(&angular, &linear)
    }
}

impl From<Vector6<f64>> for Twist {
    /// The twist with the components `(angular, linear)`.
    #[inline]
    fn from(six: Vector6<f64>) -> Self {
        let [angular, linear] = halves(&six);
        Self { angular, linear }
    }
}

impl From<Wrench> for Vector6<f64> {
    /// The wrench as one vector `(moment, force)`.
    #[inline]
    fn from(Wrench { moment, force }: Wrench) -> Self {
        six(&moment, &force)
    }
}

impl From<Vector6<f64>> for Wrench {
    /// The wrench with the components `(moment, force)`.
    #[inline]
    fn from(six: Vector6<f64>) -> Self {
        let [moment, force] = halves(&six);
        Self { moment, force }
    }
}

fn six(first: &Vector3<f64>, second: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(first.x, first.y, first.z, second.x, second.y, second.z)
}

fn halves(six: &Vector6<f64>) -> [Vector3<f64>; 2] {
    [six.fixed_rows::<3>(0).into_owned(), six.fixed_rows::<3>(3).into_owned()]
}

/// `[[diagonal, 0], [corner, diagonal]]`.
fn lower_triangle(diagonal: &Matrix3<f64>, corner: &Matrix3<f64>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(diagonal);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(diagonal);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(corner);
    matrix
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix4, Translation3};
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding of a product of two 6 x 6 matrices with entries up to 4; worst seen 8.9e-16.
    const ROUNDING: f64 = 5e-15;
    /// Rounding, and nalgebra's exponential of a 6 x 6 matrix of norm 5 (Pade); worst seen 6.7e-16.
    const EXPONENTIAL: f64 = 1e-14;

    fn twist() -> impl Strategy<Value = Twist> {
        [support::vector(), support::vector()].prop_map(|[angular, linear]| Twist { angular, linear })
    }

    fn pose() -> impl Strategy<Value = Pose> {
        support::isometry().prop_map(Pose::from)
    }

    /// The 4 x 4 matrix by nalgebra alone.
    fn homogeneous(pose: &Pose) -> Matrix4<f64> {
        Translation3::from(pose.translation).to_homogeneous() * pose.rotation.to_homogeneous()
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn the_adjoint_of_a_product_is_the_product_of_adjoints(a_from_b in pose(), b_from_c in pose()) {
            let difference = (a_from_b * b_from_c).adjoint() - a_from_b.adjoint() * b_from_c.adjoint();
            prop_assert!(support::within(difference.amax(), ROUNDING));
        }

        #[test]
        fn the_adjoint_of_the_inverse_is_the_inverse(a_from_b in pose()) {
            let difference = a_from_b.inverse().adjoint() * a_from_b.adjoint() - Matrix6::identity();
            prop_assert!(support::within(difference.amax(), ROUNDING));
        }

        #[test]
        fn the_adjoint_is_conjugation_of_the_matrix_form(a_from_b in pose(), in_b in twist()) {
            let in_a = Twist::from(a_from_b.adjoint() * Vector6::from(in_b));
            let conjugated = homogeneous(&a_from_b) * in_b.hat() * homogeneous(&a_from_b.inverse());
            prop_assert!(support::within((in_a.hat() - conjugated).amax(), ROUNDING));
            prop_assert!(support::within((in_b.transformed_by(&a_from_b).hat() - conjugated).amax(), ROUNDING));
        }

        #[test]
        fn wrenches_go_by_the_transpose_of_the_inverse(
            a_from_b in pose(), [moment, force] in [support::vector(), support::vector()],
        ) {
            let in_b = Wrench { moment, force };
            let by_matrix = a_from_b.inverse().adjoint().transpose() * Vector6::from(in_b);
            let difference = Vector6::from(in_b.transformed_by(&a_from_b)) - by_matrix;
            prop_assert!(support::within(difference.amax(), ROUNDING));
            prop_assert_eq!(Wrench::from(Vector6::from(in_b)), in_b);
        }

        #[test]
        fn the_exponential_of_the_bracket_is_the_adjoint_of_the_motion(twist in twist()) {
            let difference = twist.bracket_matrix().exp() - twist.exp(1.0).adjoint();
            prop_assert!(support::within(difference.amax(), EXPONENTIAL));
        }

        #[test]
        fn the_bracket_is_the_commutator(a in twist(), b in twist()) {
            let commutator = a.hat() * b.hat() - b.hat() * a.hat();
            prop_assert!(support::within((a.bracket(&b).hat() - commutator).amax(), ROUNDING));
            let by_matrix = a.bracket_matrix() * Vector6::from(b);
            prop_assert!(support::within((Vector6::from(a.bracket(&b)) - by_matrix).amax(), ROUNDING));
        }

        #[test]
        fn the_bracket_does_not_depend_on_the_frame(a_from_b in pose(), v in twist(), w in twist()) {
            let in_a = v.transformed_by(&a_from_b).bracket(&w.transformed_by(&a_from_b));
            let difference = Vector6::from(in_a) - Vector6::from(v.bracket(&w).transformed_by(&a_from_b));
            prop_assert!(support::within(difference.amax(), ROUNDING));
        }
    }
}
