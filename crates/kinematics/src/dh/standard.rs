//! One row of a table in the standard convention.

use nalgebra::{Matrix3, Vector3};

use crate::pose::Pose;

/// One standard row: `T = Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
///
/// Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and Control* (1st edition, 2006), eq. 3.10.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `a_m` | m | from `z0` to `z1` along `x1` |
/// | `alpha_rad` | rad | from `z0` to `z1` about `x1` |
/// | `d_m` | m | from `x0` to `x1` along `z0` |
/// | `theta_rad` | rad | from `x0` to `x1` about `z0` |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandardDh {
    /// Link length.
    pub a_m: f64,
    /// Link twist.
    pub alpha_rad: f64,
    /// Link offset.
    pub d_m: f64,
    /// Joint angle.
    pub theta_rad: f64,
}

impl StandardDh {
    /// Pose of the row's frame in the frame before it: `dh0_from_dh1`, in metres.
    ///
    /// Source: as the type, eq. 3.10 multiplied out.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::StandardDh;
    /// use nalgebra::Vector3;
    /// let row = StandardDh { a_m: 0.25, alpha_rad: 90_f64.to_radians(), d_m: 0.1, theta_rad: 30_f64.to_radians() };
    /// let expected = Vector3::new(0.25 * 0.75_f64.sqrt(), 0.125, 0.1);
    /// assert!((row.transform().translation - expected).norm() < f64::EPSILON);
    /// ```
    pub fn transform(&self) -> Pose {
        let (st, ct) = self.theta_rad.sin_cos();
        let (sa, ca) = self.alpha_rad.sin_cos();
        let rotation = Matrix3::new(
            ct,
            -st * ca,
            st * sa, //
            st,
            ct * ca,
            -ct * sa, //
            0.,
            sa,
            ca,
        );
        Pose { rotation, translation: Vector3::new(self.a_m * ct, self.a_m * st, self.d_m) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{dh::Axes, sin_cos::SinCos, support};

    /// Rounding of entries up to 3, one operation each way; worst seen 8.0e-16.
    const ROUNDING: f64 = 4e-15;

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn the_printed_matrix_is_the_product_of_its_factors([a_m, alpha_rad, d_m, theta_rad] in support::dh_figures()) {
            let printed = StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform();
            let product = support::screw_z(theta_rad, d_m) * support::screw_x(alpha_rad, a_m);
            let product = Pose::from(product);
            prop_assert!(support::within((printed.rotation - product.rotation).norm(), ROUNDING));
            prop_assert!(support::within(printed.distance_m(&product), ROUNDING));
            let stepped = Axes::of(&Pose::identity())
                .about_z(SinCos::of(theta_rad), d_m)
                .about_x(SinCos::of(alpha_rad), a_m)
                .pose();
            prop_assert!(support::within((printed.rotation - stepped.rotation).norm(), ROUNDING));
            prop_assert!(support::within(printed.distance_m(&stepped), ROUNDING));
        }
    }
}
