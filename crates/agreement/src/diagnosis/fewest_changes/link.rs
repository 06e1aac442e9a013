//! The values of one link of a table: what takes the z axis of a frame onto the axis of the next joint.

use congruent_kinematics::Pose;
use nalgebra::{Matrix3, Vector3};

use super::same_within::SameWithin;

/// The axis of a joint with its positive direction, at position zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointLine {
    pub(super) through: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
}

impl JointLine {
    /// The z axis of a frame.
    pub(super) fn along_z(frame: &Pose) -> Self {
        Self { through: frame.translation, direction: frame.rotation.column(2).into_owned() }
    }

    /// The shortest shift from a point to the line.
    pub(super) fn across(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let between = self.through - point;
        between - self.direction * between.dot(&self.direction)
    }
}

/// A turn about z, a shift along it, then a shift along the new x and a turn about it; and the frame behind.
#[derive(Debug, Clone, Copy)]
pub(super) struct LinkValues {
    pub(super) theta_rad: f64,
    pub(super) d_m: f64,
    pub(super) a_m: f64,
    pub(super) alpha_rad: f64,
    pub(super) behind: Pose,
}

/// The values that take the z axis of a frame onto a line: one for each direction of the common normal.
///
/// Source: Denavit and Hartenberg (1955). Parallel lines have any number of common normals: the one at `given.d_m` is taken,
/// and if they are the same line the direction at `given.theta_rad`, too.
pub(super) fn links_onto(
    line: &JointLine,
    frame: &Pose,
    given: &AboutZ,
    same: SameWithin,
) -> Vec<LinkValues> {
    let JointLine { through, direction: z } = JointLine::along_z(frame);
    let normal = z.cross(&line.direction);
    let sine = normal.norm();
    let between = line.through - through;
    let from_normal = |along_x: Vector3<f64>, d_m: f64, across: Vector3<f64>| -> LinkValues {
        let x = frame.rotation.column(0).into_owned();
        let theta_rad = libm::atan2(z.dot(&x.cross(&along_x)), x.dot(&along_x));
        let alpha_rad = libm::atan2(normal.dot(&along_x), z.dot(&line.direction));
        // At right angles to the line also if it is parallel to the axis only nearly.
        let y = line.direction.cross(&along_x).normalize();
        let rotation = Matrix3::from_columns(&[y.cross(&line.direction), y, line.direction]);
        let behind = Pose::from_parts(rotation, through + z * d_m + across);
        LinkValues { theta_rad, d_m, a_m: across.dot(&along_x), alpha_rad, behind }
    };
    if sine > same.parallel_rad {
        let normal = normal / sine;
        let d_m = between.cross(&line.direction).dot(&normal) / sine;
        let across = normal * between.dot(&normal);
        return vec![from_normal(normal, d_m, across), from_normal(-normal, d_m, across)];
    }
    let across = between - z * between.dot(&z);
    let distance = across.norm();
    if distance > same.length_m {
        let normal = across / distance;
        return vec![from_normal(normal, given.d_m, across), from_normal(-normal, given.d_m, across)];
    }
    let (sine, cosine) = libm::sincos(given.theta_rad);
    let along_x = frame.rotation.column(0) * cosine + frame.rotation.column(1) * sine;
    vec![from_normal(along_x, given.d_m, across)]
}

/// The given turn about z and shift along it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AboutZ {
    pub(super) theta_rad: f64,
    pub(super) d_m: f64,
}
