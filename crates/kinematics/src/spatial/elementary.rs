//! Elementary transforms: a turn about one axis, a shift along one axis, and what their order means.

use nalgebra::{Matrix3, Vector3};

use super::pose::Pose;

/// Turns about x, y, z and shifts along them.
///
/// A factor on the right moves in the current frame, the one reached so far; a factor on the left
/// moves in the fixed frame, where the whole began.
///
/// Source: Siciliano et al., *Robotics* (2009), sections 2.2.1 and 2.4.
///
/// # Examples
/// ```
/// use congruent_kinematics::Pose;
/// use std::f64::consts::FRAC_PI_2;
/// let turned = Pose::turn_z(FRAC_PI_2);
/// let along_current_x = turned * Pose::shift_x(3.0); // x of the turned frame is y of the fixed one
/// let along_fixed_x = Pose::shift_x(3.0) * turned;
/// assert!((along_current_x.translation.y - 3.0).abs() < 1e-15);
/// assert_eq!(along_fixed_x.translation.x, 3.0);
/// ```
impl Pose {
    /// `Rx(angle)`: a turn about the x axis, angle in rad.
    #[inline]
    pub fn turn_x(angle_rad: f64) -> Self {
        Self { rotation: turn(0, angle_rad), ..Self::identity() }
    }

    /// `Ry(angle)`: a turn about the y axis, angle in rad.
    #[inline]
    pub fn turn_y(angle_rad: f64) -> Self {
        Self { rotation: turn(1, angle_rad), ..Self::identity() }
    }

    /// `Rz(angle)`: a turn about the z axis, angle in rad.
    #[inline]
    pub fn turn_z(angle_rad: f64) -> Self {
        Self { rotation: turn(2, angle_rad), ..Self::identity() }
    }

    /// `Tx(by)`: a shift along the x axis, in m.
    #[inline]
    pub fn shift_x(by_m: f64) -> Self {
        Self { translation: Vector3::new(by_m, 0.0, 0.0), ..Self::identity() }
    }

    /// `Ty(by)`: a shift along the y axis, in m.
    #[inline]
    pub fn shift_y(by_m: f64) -> Self {
        Self { translation: Vector3::new(0.0, by_m, 0.0), ..Self::identity() }
    }

    /// `Tz(by)`: a shift along the z axis, in m.
    #[inline]
    pub fn shift_z(by_m: f64) -> Self {
        Self { translation: Vector3::new(0.0, 0.0, by_m), ..Self::identity() }
    }
}

/// The turn about axis 0, 1 or 2 (x, y, z) of the frame.
#[inline]
pub(crate) fn turn(axis: usize, angle_rad: f64) -> Matrix3<f64> {
    let (sin, cos) = libm::sincos(angle_rad);
    // In cyclic order the signs are the same for all three axes.
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turn = Matrix3::identity();
    (turn[(next, next)], turn[(last, last)]) = (cos, cos);
    (turn[(last, next)], turn[(next, last)]) = (sin, -sin);
    turn
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;
    use crate::{spatial::rotation::rotation_exp, support};

    /// Rounding of the half angle's sine, twice; worst seen 6.7e-16.
    const ROUNDING: f64 = 2e-15;

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn turns_are_exponentials_of_their_axes(angle_rad in -PI..PI) {
            for (axis, found) in [Pose::turn_x, Pose::turn_y, Pose::turn_z].map(|turn| turn(angle_rad)).iter().enumerate() {
                let expected = rotation_exp(&Vector3::ith(axis, angle_rad));
                prop_assert!(support::within((found.rotation - expected).amax(), ROUNDING));
                prop_assert_eq!(found.translation, Vector3::zeros());
            }
        }

        #[test]
        fn shifts_add_up(shift in support::vector()) {
            let together = Pose::shift_z(shift.z) * Pose::shift_x(shift.x) * Pose::shift_y(shift.y);
            prop_assert_eq!(together, Pose::from_parts(Matrix3::identity(), shift));
        }
    }
}
