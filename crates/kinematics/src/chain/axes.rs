//! A pose as three axes and an origin, which the rows of a chain turn and shift step by step.

use nalgebra::{Matrix3, Vector3};

use super::sin_cos::SinCos;
use crate::spatial::pose::Pose;

/// A pose as three axes and an origin. A row of a chain turns two axes and shifts the origin, which is a third of the work of a
/// matrix product.
#[derive(Debug, Clone, Copy)]
pub struct Axes {
    /// Unit vector of the x axis.
    pub x: Vector3<f64>,
    /// Unit vector of the y axis.
    pub y: Vector3<f64>,
    /// Unit vector of the z axis.
    pub z: Vector3<f64>,
    /// Position of the origin, m.
    pub origin: Vector3<f64>,
}

impl Axes {
    /// The axes of a pose.
    #[inline]
    #[must_use]
    pub fn from_pose(pose: &Pose) -> Self {
        let column = |at: usize| pose.rotation.column(at).into_owned();
        Self { x: column(0), y: column(1), z: column(2), origin: pose.translation }
    }

    /// The pose that has these axes.
    #[inline]
    pub fn pose(&self) -> Pose {
        let Self { x, y, z, origin } = self;
        let rotation = Matrix3::new(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
        Pose { rotation, translation: *origin }
    }

    /// The pose multiplied from the right by `Rz(theta)`.
    #[inline]
    #[must_use]
    pub fn turned_about_z(&self, theta: SinCos) -> Self {
        Self {
            x: self.x * theta.cos + self.y * theta.sin,
            y: self.y * theta.cos - self.x * theta.sin,
            ..*self
        }
    }

    /// The pose multiplied from the right by `Rx(alpha)`.
    #[inline]
    #[must_use]
    pub fn turned_about_x(&self, alpha: SinCos) -> Self {
        Self {
            y: self.y * alpha.cos + self.z * alpha.sin,
            z: self.z * alpha.cos - self.y * alpha.sin,
            ..*self
        }
    }

    /// The pose multiplied from the right by `Rz(theta) Tz(d)`.
    #[inline]
    #[must_use]
    pub fn about_z(&self, theta: SinCos, d_m: f64) -> Self {
        Self { origin: self.origin + self.z * d_m, ..self.turned_about_z(theta) }
    }

    /// The pose multiplied from the right by `Tx(a) Rx(alpha)`.
    #[inline]
    #[must_use]
    pub fn about_x(&self, alpha: SinCos, a_m: f64) -> Self {
        Self { origin: self.origin + self.x * a_m, ..self.turned_about_x(alpha) }
    }

    /// The pose multiplied from the right by a translation by `shift`.
    #[inline]
    #[must_use]
    pub fn shifted(&self, shift: &Vector3<f64>) -> Self {
        let origin = self.x * shift.x + self.y * shift.y + self.z * shift.z + self.origin;
        Self { origin, ..*self }
    }

    /// The pose multiplied from the right by any pose.
    #[inline]
    pub fn times(&self, here_from_there: &Pose) -> Pose {
        let Pose { rotation, translation: p } = here_from_there;
        let turned = |column: usize| {
            let along = |row: usize| rotation[(row, column)];
            self.x * along(0) + self.y * along(1) + self.z * along(2)
        };
        let origin = self.x * p.x + self.y * p.y + self.z * p.z + self.origin;
        Self { x: turned(0), y: turned(1), z: turned(2), origin }.pose()
    }
}
