//! One row of a table in the modified convention.

use congruent_description::DhConvention;
use nalgebra::{Matrix3, Vector3};

use super::conditions::NotADhTransform;
use crate::spatial::pose::Pose;

/// One modified row: `T = Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
///
/// Source: Craig, *Introduction to Robotics* (3rd edition, 2005), eq. 3.6. `a` and `alpha` are those of
/// the preceding link, Craig's `a_{i-1}` and `alpha_{i-1}`.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `a_m` | m | from `z0` to `z1` along `x0` |
/// | `alpha_rad` | rad | from `z0` to `z1` about `x0` |
/// | `d_m` | m | from `x0` to `x1` along `z1` |
/// | `theta_rad` | rad | from `x0` to `x1` about `z1` |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModifiedDh {
    /// Length a of the preceding link, m.
    pub a_m: f64,
    /// Twist alpha of the preceding link, rad.
    pub alpha_rad: f64,
    /// Link offset d, m.
    pub d_m: f64,
    /// Joint angle theta, rad.
    pub theta_rad: f64,
}

impl ModifiedDh {
    /// Pose of the row's frame in the frame before it: `dh0_from_dh1`, in metres.
    ///
    /// Source: as the type, eq. 3.6.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::ModifiedDh;
    /// use nalgebra::Vector3;
    /// let row = ModifiedDh { a_m: 0.25, alpha_rad: 90_f64.to_radians(), d_m: 0.1, theta_rad: 30_f64.to_radians() };
    /// // d goes along the new z axis, which alpha turned to -y.
    /// assert!((row.transform().translation - Vector3::new(0.25, -0.1, 0.)).norm() < f64::EPSILON);
    /// ```
    pub fn transform(&self) -> Pose {
        let (st, ct) = libm::sincos(self.theta_rad);
        let (sa, ca) = libm::sincos(self.alpha_rad);
        let rotation = Matrix3::new(
            ct,
            -st,
            0., //
            st * ca,
            ct * ca,
            -sa, //
            st * sa,
            ct * sa,
            ca,
        );
        Pose { rotation, translation: Vector3::new(self.a_m, -sa * self.d_m, ca * self.d_m) }
    }

    /// The row with this transform, which is unique; `alpha` and `theta` in `-pi..=pi`.
    ///
    /// Source: as [`NotADhTransform`]: existence and uniqueness, of the inverse.
    ///
    /// # Errors
    /// [`NotADhTransform`] when `x0` is not perpendicular to `z1`, or does not meet it.
    /// # Examples
    /// ```
    /// use congruent_kinematics::ModifiedDh;
    /// let row = ModifiedDh { a_m: 0.25, alpha_rad: -0.5, d_m: 0.1, theta_rad: 2.0 };
    /// let found = ModifiedDh::from_transform(&row.transform())?;
    /// assert!((found.alpha_rad + 0.5).abs() < f64::EPSILON && (found.d_m - 0.1).abs() < f64::EPSILON);
    /// # Ok::<(), congruent_kinematics::NotADhTransform>(())
    /// ```
    pub fn from_transform(dh0_from_dh1: &Pose) -> Result<Self, NotADhTransform> {
        // The inverse of a modified row, Tz(-d) Rz(-theta) Tx(-a) Rx(-alpha), has the form of a standard row: its x
        // axis and origin are those that the conditions speak of.
        let Pose { rotation, translation } = dh0_from_dh1.inverse();
        let x = rotation.column(0).into_owned();
        NotADhTransform::check(DhConvention::Modified, &x, &translation)?;
        Ok(Self {
            a_m: dh0_from_dh1.translation.x,
            alpha_rad: libm::atan2(-rotation[(2, 1)], rotation[(2, 2)]),
            d_m: -translation.z,
            theta_rad: libm::atan2(-x.y, x.x),
        })
    }
}
