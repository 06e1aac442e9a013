//! Convex forms as parry takes them, and conversions to its types.

use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use parry3d_f64::{
    math::{Pose, Rotation, Vector},
    shape::{Ball, Shape, SharedShape, SupportMap},
};

/// A convex form: one that parry has methods for, or an ellipsoid, of which it takes support points alone.
#[derive(Clone)]
pub(super) enum ConvexForm {
    Parry(SharedShape),
    Ellipsoid(EllipsoidForm),
}

/// An ellipsoid about the origin, its axes along x, y, z.
#[derive(Clone, Copy)]
pub(super) struct EllipsoidForm {
    /// Half of its extent along each axis, m; each is above 0.
    pub(super) semi_axes_m: Vector,
}

impl ConvexForm {
    pub(super) fn support_map(&self) -> &dyn SupportMap {
        match self {
            Self::Parry(form) => support_map(&**form),
            Self::Ellipsoid(form) => form,
        }
    }

    /// The form without its border of constant width, and that width, m: of a ball its centre and its radius.
    pub(super) fn core(&self) -> (&dyn SupportMap, f64) {
        match self.as_parry().and_then(|form| form.as_ball()) {
            Some(ball) => (&Ball { radius: 0.0 }, ball.radius),
            None => (self.support_map(), 0.0),
        }
    }

    pub(super) fn as_parry(&self) -> Option<&dyn Shape> {
        match self {
            Self::Parry(form) => Some(&**form),
            Self::Ellipsoid(_) => None,
        }
    }
}

impl SupportMap for EllipsoidForm {
    /// It is the unit ball stretched by `S = diag(a, b, c)`: over unit vectors `u` the largest `(S u) . d = u . (S d)` is at
    /// `u = S d / |S d|`.
    fn local_support_point(&self, along: Vector) -> Vector {
        // Along no direction every point is the farthest.
        let on_ball = (self.semi_axes_m * along).try_normalize().unwrap_or(Vector::X);
        self.semi_axes_m * on_ball
    }
}

pub(super) fn support_map(form: &dyn Shape) -> &dyn SupportMap {
    form.as_support_map().expect("boxes, balls, cylinders and hulls have support points")
}

pub(super) fn vector(vector: &Vector3<f64>) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}

pub(super) fn from_parry(vector: Vector) -> Vector3<f64> {
    Vector3::new(vector.x, vector.y, vector.z)
}

pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let turn = pose.rotation;
    let quaternion = Quaternion::new(turn.w, turn.x, turn.y, turn.z);
    Isometry3::from_parts(from_parry(pose.translation).into(), UnitQuaternion::from_quaternion(quaternion))
}

pub(super) fn pose(isometry: &Isometry3<f64>) -> Pose {
    let (shift, turn) = (&isometry.translation, isometry.rotation.coords);
    Pose::from_parts(
        Vector::new(shift.x, shift.y, shift.z),
        Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w),
    )
}
