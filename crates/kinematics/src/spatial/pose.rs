//! Poses: a rotation matrix and a translation. Their exponentials and logarithms are `twist.rs`.

use std::{cmp::Ordering, ops::Mul};

use nalgebra::{Isometry3, Matrix3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::rotation::{quaternion_of, vee};

/// A rigid motion; under the name `a_from_b` the pose of frame b in frame a.
///
/// A matrix and not a quaternion, because forward kinematics multiplies many and normalises none.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | `rotation` | 3 x 3 | 1 | columns are the axes of b in a |
/// | `translation` | 3 | m | origin of b in a |
///
/// # Examples
/// ```
/// use congruent_kinematics::Pose;
/// use nalgebra::{Matrix3, Point3, Vector3};
/// let quarter_turn_about_z = Matrix3::new(0., -1., 0., 1., 0., 0., 0., 0., 1.);
/// let world_from_base = Pose::from_parts(quarter_turn_about_z, Vector3::new(1., 0., 0.));
/// let base_from_tcp = Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0., 0.));
/// let world_from_tcp = world_from_base * base_from_tcp;
/// assert_eq!(world_from_tcp.translation, Vector3::new(1., 0.5, 0.));
/// assert_eq!(world_from_base.transform_point(&Point3::new(0., 2., 0.)), Point3::new(-1., 0., 0.));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Orientation: orthonormal, determinant 1.
    pub rotation: Matrix3<f64>,
    /// Position of the origin, m.
    pub translation: Vector3<f64>,
}

impl Pose {
    /// The motion that moves nothing: `a_from_a`.
    #[inline]
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// From a rotation matrix and a translation in metres; the matrix is taken as it is.
    #[inline]
    pub fn from_parts(rotation: Matrix3<f64>, translation: Vector3<f64>) -> Self {
        Self { rotation, translation }
    }

    /// `b_from_a` of `a_from_b`: `(R^T, -R^T p)`, which supposes an orthonormal `rotation`.
    ///
    /// Source: Lynch & Park, *Modern Robotics* (2017), proposition 3.15.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Pose;
    /// use nalgebra::{Matrix3, Vector3};
    /// let turned = Matrix3::new(0., -1., 0., 1., 0., 0., 0., 0., 1.);
    /// let a_from_b = Pose::from_parts(turned, Vector3::new(3., 1., 0.));
    /// assert_eq!(a_from_b.inverse().translation, Vector3::new(-1., 3., 0.));
    /// assert_eq!(a_from_b * a_from_b.inverse(), Pose::identity());
    /// ```
    #[inline]
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// A point given in frame b, in frame a: turned and shifted.
    #[inline]
    pub fn transform_point(&self, point_in_b: &Point3<f64>) -> Point3<f64> {
        Point3::from(self.rotation * point_in_b.coords + self.translation)
    }

    /// A direction given in frame b, in frame a: turned only.
    #[inline]
    pub fn transform_vector(&self, vector_in_b: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * vector_in_b
    }

    /// The same motion with a unit quaternion; what is not orthonormal in the matrix is lost.
    pub fn to_isometry(&self) -> Isometry3<f64> {
        let [w, x, y, z] = self.quaternion_wxyz();
        Isometry3::from_parts(
            Translation3::from(self.translation),
            UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)),
        )
    }

    /// Orientation as the one unit quaternion `(w, x, y, z)` of the two whose first component that
    /// is not zero is positive; so `w >= 0`.
    ///
    /// Source: Shepperd, *Quaternion from rotation matrix* (1978): the largest component first, so
    /// that no division is by a small number.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Pose;
    /// use nalgebra::{Matrix3, Vector3};
    /// let half_turn_about_y = Matrix3::from_diagonal(&Vector3::new(-1., 1., -1.));
    /// let pose = Pose::from_parts(half_turn_about_y, Vector3::zeros());
    /// assert_eq!(pose.quaternion_wxyz(), [0., 0., 1., 0.]);
    /// ```
    pub fn quaternion_wxyz(&self) -> [f64; 4] {
        quaternion_of(&self.rotation)
    }

    /// Distance of the origins of two poses in one frame, in metres.
    #[inline]
    pub fn distance_m(&self, other: &Self) -> f64 {
        (self.translation - other.translation).norm()
    }

    /// Angle of the turn between two orientations, in `0..=pi` radians.
    ///
    /// `atan2(sin, cos)` keeps full accuracy near 0 and near pi, at which an arc cosine or sine alone
    /// loses half of the digits.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, rotation_exp};
    /// use nalgebra::Vector3;
    /// let turned = |x: f64| Pose::from_parts(rotation_exp(&Vector3::new(x, 0., 0.)), Vector3::zeros());
    /// assert_eq!(turned(0.0).angle_rad(&turned(1e-12)), 1e-12);
    /// assert_eq!(turned(0.0).angle_rad(&turned(std::f64::consts::PI)), std::f64::consts::PI);
    /// ```
    pub fn angle_rad(&self, other: &Self) -> f64 {
        let between = self.rotation.transpose() * other.rotation;
        let sine = vee(&(between - between.transpose())).norm() / 2.0;
        libm::atan2(sine, (between.trace() - 1.0) / 2.0)
    }

    /// How far the matrix is from orthonormal: the Frobenius norm of `R^T R - I`.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Pose;
    /// use nalgebra::{Matrix3, Vector3};
    /// let stretched = Pose::from_parts(Matrix3::identity() * 2.0, Vector3::zeros());
    /// assert_eq!(stretched.orthonormality_error(), 27_f64.sqrt()); // three times 2^2 - 1 = 3
    /// assert_eq!(stretched.determinant(), 8.0);
    /// ```
    pub fn orthonormality_error(&self) -> f64 {
        (self.rotation.transpose() * self.rotation - Matrix3::identity()).norm()
    }

    /// Determinant of the matrix: 1 for a rotation, -1 for a mirror.
    pub fn determinant(&self) -> f64 {
        self.rotation.determinant()
    }

    /// The pose with the rotation nearest to its matrix (in the Frobenius norm), for poses that long
    /// products or written values have left a little off; `None` if the determinant is not
    /// positive, for a mirror is no rotation that is off.
    ///
    /// Source: Higham, *Functions of Matrices* (2008), eq. 8.17: Newton's iteration for the polar
    /// factor, `(R + R^-T) / 2`, which doubles the right digits in every step.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::Pose;
    /// use nalgebra::{Matrix3, Vector3};
    /// let sheared = Pose::from_parts(Matrix3::identity() + Vector3::x() * Vector3::y().transpose() * 1e-3, Vector3::x());
    /// let corrected = sheared.orthonormalized().unwrap();
    /// assert!(corrected.orthonormality_error() < 4.0 * f64::EPSILON);
    /// // The shear of 1e-3 is half a turn of 1e-3, half a stretch.
    /// assert!((corrected.angle_rad(&Pose::identity()) - 0.5e-3).abs() < 1e-9);
    /// assert_eq!(Pose::from_parts(-Matrix3::identity(), Vector3::zeros()).orthonormalized(), None);
    /// ```
    #[must_use]
    pub fn orthonormalized(&self) -> Option<Self> {
        /// Each step halves a large stretch: enough for one of 1e15, beyond which a matrix is singular.
        const MOST_STEPS: usize = 64;
        let mut rotation = self.rotation;
        // Not `<= 0`, which a NaN would pass.
        if self.determinant().partial_cmp(&0.0) != Some(Ordering::Greater) {
            return None;
        }
        for _ in 0..MOST_STEPS {
            let step = (rotation.try_inverse()?.transpose() - rotation) / 2.0;
            rotation += step;
            // The error after a step is its square.
            if step.norm() < f64::EPSILON.sqrt() {
                return Some(Self { rotation, ..*self });
            }
        }
        None
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::identity()
    }
}

impl Mul for Pose {
    type Output = Self;

    /// `a_from_b * b_from_c = a_from_c`.
    #[inline]
    fn mul(self, b_from_c: Self) -> Self {
        Self {
            rotation: self.rotation * b_from_c.rotation,
            translation: self.rotation * b_from_c.translation + self.translation,
        }
    }
}

impl Mul<Point3<f64>> for Pose {
    type Output = Point3<f64>;

    #[inline]
    fn mul(self, point_in_b: Point3<f64>) -> Point3<f64> {
        self.transform_point(&point_in_b)
    }
}

impl From<Isometry3<f64>> for Pose {
    fn from(a_from_b: Isometry3<f64>) -> Self {
        Self {
            rotation: a_from_b.rotation.to_rotation_matrix().into_inner(),
            translation: a_from_b.translation.vector,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::{spatial::rotation::rotation_exp, support};

    /// Rounding: a product of two poses within 3 m costs some ten roundings of 3 eps; worst seen 1.5e-15.
    const ROUNDING_M: f64 = 1e-14;
    /// Rounding of entries of size 1, ten operations; worst seen 9.8e-16.
    const ROUNDING_RAD: f64 = 1e-14;

    fn turned(x: f64, y: f64, z: f64) -> Pose {
        Pose::from_parts(rotation_exp(&Vector3::new(x, y, z)), Vector3::new(1.0, -2.0, 0.5))
    }

    #[track_caller]
    fn assert_angle(rad: f64) {
        let about = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let other = turned(0.2, 0.9, -0.4);
        let rotation = other.rotation * rotation_exp(&(about * rad));
        let found = other.angle_rad(&Pose { rotation, ..other });
        assert!(support::within((found - rad).abs(), ROUNDING_RAD), "{found} for {rad}");
    }

    #[test]
    fn the_angle_is_accurate_from_zero_to_pi() {
        for rad in [0.0, 1e-14, 1e-9, 1e-5, 0.1, 1.0, PI / 2.0, 3.0, PI - 1e-7, PI - 1e-10, PI] {
            assert_angle(rad);
        }
    }

    #[test]
    fn a_mirror_has_determinant_minus_one_and_no_orthonormality_error() {
        let mirror = Pose::from_parts(Matrix3::from_diagonal(&Vector3::new(1., 1., -1.)), Vector3::zeros());
        assert!(support::within((mirror.determinant() + 1.0).abs(), f64::EPSILON));
        assert!(support::within(mirror.orthonormality_error(), f64::EPSILON));
    }

    #[test]
    fn a_stretched_matrix_shows() {
        let stretched = Pose::from_parts(Matrix3::identity() * 2.0, Vector3::zeros());
        assert!(support::within((stretched.orthonormality_error() - 27.0_f64.sqrt()).abs(), ROUNDING_RAD));
    }

    #[test]
    fn what_has_no_nearest_rotation_has_none() {
        let flat = Matrix3::from_diagonal(&Vector3::new(1., 1., 0.));
        for matrix in [flat, -Matrix3::identity(), Matrix3::repeat(f64::NAN), Matrix3::repeat(f64::INFINITY)]
        {
            assert_eq!(Pose::from_parts(matrix, Vector3::zeros()).orthonormalized(), None);
        }
    }

    #[test]
    fn half_turns_have_the_positive_quaternion() {
        for (axis, wxyz) in [(0, [0., 1., 0., 0.]), (1, [0., 0., 1., 0.]), (2, [0., 0., 0., 1.])] {
            let mut diagonal = Vector3::repeat(-1.0);
            diagonal[axis] = 1.0;
            let pose = Pose::from_parts(Matrix3::from_diagonal(&diagonal), Vector3::zeros());
            assert_eq!(pose.quaternion_wxyz().map(f64::to_bits), wxyz.map(f64::to_bits));
        }
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn a_pose_times_its_inverse_moves_nothing(pose in support::isometry()) {
            let pose = Pose::from(pose);
            for product in [pose * pose.inverse(), pose.inverse() * pose] {
                prop_assert!(support::within(product.distance_m(&Pose::identity()), ROUNDING_M));
                prop_assert!(support::within(product.angle_rad(&Pose::identity()), ROUNDING_RAD));
            }
        }

        /// The nearest rotation to `R S`, `S` symmetric and positive, is `R` (Higham, theorem 8.4).
        #[test]
        fn a_stretch_is_taken_out(
            pose in support::isometry(), along in support::isometry(), exponents in proptest::array::uniform3(-3.0..3.0),
        ) {
            let (pose, along) = (Pose::from(pose), Pose::from(along).rotation);
            let stretch = Vector3::from(exponents).map(|exponent: f64| 10_f64.powf(exponent));
            let symmetric = along * Matrix3::from_diagonal(&stretch) * along.transpose();
            let stretched = Pose { rotation: pose.rotation * symmetric, ..pose };
            let corrected = stretched.orthonormalized().unwrap();
            prop_assert!(support::within(corrected.orthonormality_error(), ROUNDING_RAD));
            // A rounding of the largest stretch turns by its share of the smallest two.
            let mut sizes: [f64; 3] = stretch.into();
            sizes.sort_by(f64::total_cmp);
            let condition = sizes[2] / (sizes[0] + sizes[1]);
            prop_assert!(support::within(corrected.angle_rad(&pose) / (1.0 + condition), ROUNDING_RAD));
        }

        #[test]
        fn products_are_those_of_isometries(a in support::isometry(), b in support::isometry()) {
            let (by_matrix, by_quaternion) = (Pose::from(a) * Pose::from(b), Pose::from(a * b));
            prop_assert!(support::within(by_matrix.distance_m(&by_quaternion), ROUNDING_M));
            prop_assert!(support::within(by_matrix.angle_rad(&by_quaternion), ROUNDING_RAD));
            let there_and_back = Pose::from(by_matrix.to_isometry());
            prop_assert!(support::within(there_and_back.angle_rad(&by_matrix), ROUNDING_RAD));
            prop_assert_eq!(there_and_back.translation, by_matrix.translation);
        }
    }
}
