//! One row of a table in the standard convention.

use congruent_description::DhConvention;
use nalgebra::{Matrix3, Vector3};

use super::conditions::NotADhTransform;
use crate::spatial::pose::Pose;

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
    /// Link length a, m.
    pub a_m: f64,
    /// Link twist alpha, rad.
    pub alpha_rad: f64,
    /// Link offset d, m.
    pub d_m: f64,
    /// Joint angle theta, rad.
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
        let (st, ct) = libm::sincos(self.theta_rad);
        let (sa, ca) = libm::sincos(self.alpha_rad);
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

    /// The row with this transform, which is unique; `alpha` and `theta` in `-pi..=pi`.
    ///
    /// Source: as [`NotADhTransform`]: existence and uniqueness.
    ///
    /// # Errors
    /// [`NotADhTransform`] when `x1` is not perpendicular to `z0`, or does not meet it.
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, StandardDh};
    /// use nalgebra::Vector3;
    /// let row = StandardDh { a_m: 0.25, alpha_rad: -0.5, d_m: 0.1, theta_rad: 2.0 };
    /// let found = StandardDh::from_transform(&row.transform())?;
    /// assert!((found.theta_rad - 2.0).abs() < 4.0 * f64::EPSILON && (found.a_m - 0.25).abs() < f64::EPSILON);
    /// // Shifted along y0 = y1 the axes pass each other.
    /// let beside = Pose { translation: Vector3::new(0.0, 0.003, 0.0), ..Pose::identity() };
    /// let refused = StandardDh::from_transform(&beside).unwrap_err();
    /// assert_eq!(refused.off_meeting_m, 0.003);
    /// # Ok::<(), congruent_kinematics::NotADhTransform>(())
    /// ```
    pub fn from_transform(dh0_from_dh1: &Pose) -> Result<Self, NotADhTransform> {
        let Pose { rotation, translation } = dh0_from_dh1;
        let x = rotation.column(0).into_owned();
        NotADhTransform::check(DhConvention::Standard, &x, translation)?;
        Ok(Self {
            // Along x1: (a cos theta, a sin theta) projected on it keeps the sign of `a`, which a norm would lose.
            a_m: translation.x * x.x + translation.y * x.y,
            alpha_rad: libm::atan2(rotation[(2, 1)], rotation[(2, 2)]),
            d_m: translation.z,
            theta_rad: libm::atan2(x.y, x.x),
        })
    }
}
