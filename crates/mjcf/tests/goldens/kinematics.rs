//! Poses of bodies from the model alone: what each joint does to its body, in their order.

use congruent_mjcf::{MjJoint, MjJointKind, MjModel};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// World poses of all bodies; `q` has one position for each hinge and slide, other joints are at rest.
pub(crate) fn world_from_bodies(model: &MjModel, q: &[f64]) -> Vec<Isometry3<f64>> {
    let mut positions = q.iter();
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for (index, body) in model.bodies.iter().enumerate() {
        let world_from_parent = body.parent.map_or_else(Isometry3::identity, |parent| poses[parent]);
        let mut pose = world_from_parent * body.parent_from_body;
        for joint in model.joints_of(index) {
            if joint.kind.positions() == 1 {
                pose *= motion(joint, positions.next().unwrap() - joint.reference.value);
            }
        }
        poses.push(pose);
    }
    assert_eq!(positions.next(), None);
    poses
}

/// What a joint adds, in the body: a turn about an axis through its point, or a shift.
fn motion(joint: &MjJoint, position: f64) -> Isometry3<f64> {
    let axis = joint.axis_in_body.value;
    if joint.kind == MjJointKind::Slide {
        return Translation3::from(axis.into_inner() * position).into();
    }
    let to_axis = Translation3::from(joint.pos_in_body.value);
    to_axis * UnitQuaternion::from_axis_angle(&axis, position) * to_axis.inverse()
}

/// A pose of a golden: position, then quaternion with w first.
pub(crate) fn pose(numbers: &[f64]) -> Isometry3<f64> {
    let [x, y, z, qw, qx, qy, qz] = numbers.try_into().unwrap();
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(qw, qx, qy, qz));
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// The larger of the distance, m, and the angle, rad, between two poses.
pub(crate) fn difference(one: &Isometry3<f64>, other: &Isometry3<f64>) -> f64 {
    let relative = one.inverse() * other;
    relative.translation.vector.norm().max(2.0 * relative.rotation.imag().norm())
}
