//! Rotations alone: exponential, logarithm and quaternion of a 3 x 3 matrix, and the hat and vee
//! between vectors and skew matrices. Rigid motions are `twist.rs`.

use nalgebra::{Matrix3, Vector3};

/// The skew matrix `[v]` of a vector: `[v] w = v x w`.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), definition 3.7.
///
/// # Examples
/// ```
/// use congruent_kinematics::{hat, vee};
/// use nalgebra::Vector3;
/// let (v, w) = (Vector3::new(1., 2., 3.), Vector3::new(-4., 0., 5.));
/// assert_eq!(hat(&v) * w, v.cross(&w));
/// assert_eq!(vee(&hat(&v)), v);
/// ```
#[inline]
pub fn hat(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// The vector of a skew matrix, the inverse of [`hat`]; of another matrix only the lower left,
/// upper right and lower middle entries are read.
#[inline]
pub fn vee(skew: &Matrix3<f64>) -> Vector3<f64> {
    Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
}

/// The rotation about `turn_rad` by its length: `exp([turn])`.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `turn_rad` | 3 | rad | axis times angle |
/// | result | SO(3) | 1 | the same |
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 3.51 (Rodrigues).
///
/// # Examples
/// ```
/// use congruent_kinematics::rotation_exp;
/// use nalgebra::{Matrix3, Vector3};
/// let half_turn = rotation_exp(&(Vector3::z() * std::f64::consts::PI));
/// assert!((half_turn - Matrix3::from_diagonal(&Vector3::new(-1., -1., 1.))).norm() < 4.0 * f64::EPSILON);
/// ```
pub fn rotation_exp(turn_rad: &Vector3<f64>) -> Matrix3<f64> {
    let angle = turn_rad.norm();
    let skew = hat(turn_rad);
    Matrix3::identity() + skew * sinc(angle) + skew * skew * half_versine_ratio(angle)
}

/// Axis times angle of a rotation, the angle in `0..=pi`; the inverse of [`rotation_exp`].
///
/// It goes through the quaternion, whose half angle is `atan2(|v|, w)`: accurate at 0 and at pi
/// alike. Of the two axes of a half turn the one with a positive first component is taken.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `rotation` | SO(3) | 1 | any |
/// | result | 3 | rad | the same |
///
/// # Examples
/// ```
/// use congruent_kinematics::{rotation_exp, rotation_log};
/// use nalgebra::Vector3;
/// let tiny = Vector3::new(1e-13, -2e-13, 0.);
/// assert_eq!(rotation_log(&rotation_exp(&tiny)), tiny);
/// ```
pub fn rotation_log(rotation: &Matrix3<f64>) -> Vector3<f64> {
    let [w, x, y, z] = quaternion_of(rotation);
    let v = Vector3::new(x, y, z);
    let sine = v.norm();
    // Below the smallest normal number the ratio is its limit, 2 / w with w = 1.
    let ratio = if sine < f64::MIN_POSITIVE { 2.0 } else { 2.0 * libm::atan2(sine, w) / sine };
    v * ratio
}

/// Shepperd's unit quaternion `(w, x, y, z)`, its first component that is not zero positive.
pub fn quaternion_of(rotation: &Matrix3<f64>) -> [f64; 4] {
    let m = |row, column| rotation[(row, column)];
    let trace = rotation.trace();
    // Four times the products of the largest component with all four; the largest is at least 1/2.
    let squares = [trace, m(0, 0), m(1, 1), m(2, 2)];
    let largest = (1..4).fold(0, |best, at| if squares[at] > squares[best] { at } else { best });
    let products = match largest {
        0 => [1.0 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)],
        1 => [m(2, 1) - m(1, 2), 1.0 + 2.0 * m(0, 0) - trace, m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)],
        2 => [m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), 1.0 + 2.0 * m(1, 1) - trace, m(1, 2) + m(2, 1)],
        _ => [m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), 1.0 + 2.0 * m(2, 2) - trace],
    };
    let norm = products.iter().map(|product| product * product).sum::<f64>().sqrt();
    let first = products.iter().find(|product| **product != 0.0).map_or(1.0, |product| product.signum());
    // Adding zero turns a negative zero into a positive one.
    products.map(|product| first * product / norm + 0.0)
}

/// `sin(x) / x`, 1 at 0.
pub(crate) fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { libm::sin(x) / x }
}

/// `(1 - cos x) / x^2`, 1/2 at 0; by the half angle, which cancels nothing.
pub(crate) fn half_versine_ratio(x: f64) -> f64 {
    let half = sinc(x / 2.0);
    half * half / 2.0
}

/// A rotation whose third column is a unit vector; exact if that is along an axis.
///
/// # Examples
/// ```
/// use congruent_kinematics::frame_about;
/// use nalgebra::Vector3;
/// assert_eq!(frame_about(&Vector3::z()).column(2), Vector3::z());
/// ```
pub fn frame_about(z: &Vector3<f64>) -> Matrix3<f64> {
    let mut least = Vector3::zeros();
    // The unit axis that is farthest from parallel to z, so that the product is well-conditioned.
    least[z.iamin()] = 1.0;
    let y = z.cross(&least).normalize();
    Matrix3::from_columns(&[y.cross(z), y, *z])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding of a dozen operations on numbers up to pi; worst seen 1.3e-15.
    const ROUNDING_RAD: f64 = 1e-14;

    #[track_caller]
    fn assert_round_trip(axis: Vector3<f64>, angle: f64) {
        let turn = axis.normalize() * angle;
        let back = rotation_log(&rotation_exp(&turn));
        assert!(support::within((back - turn).norm(), ROUNDING_RAD), "{back} for {turn}");
    }

    #[test]
    fn log_undoes_exp_at_the_ends_of_the_range() {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(1., -2., 3.)] {
            for angle in
                [0.0, 1e-300, 1e-160, 1e-15, 1e-12, 1e-8, 1e-3, 0.5, PI - 1e-4, PI - 1e-9, PI - 1e-14]
            {
                assert_round_trip(axis, angle);
            }
        }
    }

    #[test]
    fn tiny_turns_keep_their_digits() {
        /// Rounding of the quaternion and of its norm, relative to the turn; worst seen 0.
        const RELATIVE: f64 = 4.0 * f64::EPSILON;
        let turn = Vector3::new(3e-12, -4e-12, 0.0);
        let back = rotation_log(&rotation_exp(&turn));
        assert!(support::within((back - turn).norm(), RELATIVE * turn.norm()));
    }

    #[test]
    fn a_half_turn_has_an_axis_with_positive_first_component() {
        for axis in [Vector3::new(2., -1., 2.), Vector3::new(-2., 1., -2.)] {
            let turn = rotation_log(&rotation_exp(&(axis * (PI / 3.0))));
            assert!(support::within((turn.norm() - PI).abs(), ROUNDING_RAD));
            assert!(support::within((turn.cross(&axis)).norm(), 3.0 * ROUNDING_RAD));
        }
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn log_undoes_exp(axis in support::unit_vector(), angle in 0.0..PI) {
            let turn = axis.into_inner() * angle;
            let back = rotation_log(&rotation_exp(&turn));
            prop_assert!(support::within((back - turn).norm(), ROUNDING_RAD));
        }

        #[test]
        fn log_undoes_exp_near_pi(axis in support::unit_vector(), exponent in -14.0..-1.0) {
            let turn = axis.into_inner() * (PI - 10_f64.powf(exponent));
            let back = rotation_log(&rotation_exp(&turn));
            prop_assert!(support::within((back - turn).norm(), ROUNDING_RAD));
        }

        #[test]
        fn log_undoes_exp_near_zero(axis in support::unit_vector(), exponent in -30.0..0.0) {
            let turn = axis.into_inner() * 10_f64.powf(exponent);
            let back = rotation_log(&rotation_exp(&turn));
            prop_assert!(support::within((back - turn).norm(), ROUNDING_RAD * turn.norm()));
        }
    }
}
