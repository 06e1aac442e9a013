//! The frame of a joint, moved as little as possible so that its axis is a given screw.

use congruent_description::Joint;
use congruent_kinematics::{Pose, Twist};
use nalgebra::{Quaternion, UnitQuaternion};

/// How far the direction of a twist may be from length 1. Kind: rounding of the identification of screws, worst seen 1e-14; a joint
/// that moves less than its variable says is off by far more.
const UNIT: f64 = 1e-9;

/// `base_from_joint` turned and shifted so that the joint moves by `twist_in_base`: about its axis through its origin if it turns,
/// along it if it slides. `None` if no joint with this axis does, or if the axis points the other way.
///
/// A URDF that is written with few digits is off the screws of its table by their rounding, which would remain as an error of the
/// corrected robot.
pub(super) fn joint_on_screw(base_from_joint: &Pose, joint: &Joint, twist_in_base: &Twist) -> Option<Pose> {
    let is_angular = joint.kind.is_angular();
    let written = if is_angular { twist_in_base.angular } else { twist_in_base.linear };
    let is_unit = (written.norm() - 1.0).abs() <= UNIT;
    let is_of_its_kind = is_angular || twist_in_base.angular.norm() <= UNIT;
    let axis = base_from_joint.rotation * joint.axis_in_joint.into_inner();
    let along = axis.dot(&written);
    if !(is_unit && is_of_its_kind && along > 0.0) {
        return None;
    }
    let direction = written.normalize();
    // Half-angle form: the quaternion (1 + a.b, a x b) turns a to b with all digits, where an arc cosine of a.b near 1 would lose half.
    let turn = Quaternion::from_parts(1.0 + axis.dot(&direction), axis.cross(&direction));
    let turn = UnitQuaternion::from_quaternion(turn).to_rotation_matrix().into_inner();
    let here = base_from_joint.translation;
    let origin = if is_angular {
        // v = -w x q, so w x v is the point of the axis that is nearest to the base; from there along the axis.
        direction.cross(&(twist_in_base.linear / written.norm())) + direction * direction.dot(&here)
    } else {
        here
    };
    Some(Pose::from_parts(turn * base_from_joint.rotation, origin))
}

#[cfg(test)]
mod tests {
    use congruent_description::{JointKind, JointParts};
    use nalgebra::{Isometry3, Matrix3, Vector3};

    use super::*;

    /// Rounding of a few products within 1 m, m and rad.
    const ROUNDING: f64 = 1e-15;

    /// A joint about or along the z axis of its frame.
    fn joint(kind: JointKind) -> Joint {
        JointParts::new("joint", kind, "link", "next", Isometry3::identity()).joint
    }

    #[test]
    fn an_axis_that_is_off_by_little_comes_to_lie_on_the_screw() {
        // So little that its cosine is 1: a turn by an arc cosine would be none.
        let tilt = 1e-9;
        let base_from_joint = Twist { angular: Vector3::x(), linear: Vector3::zeros() }.exp(tilt)
            * Pose::from_parts(Matrix3::identity(), Vector3::new(0.3, 1e-4, 0.7));
        let screw = Twist::turn(Vector3::z(), &Vector3::new(0.3, 0.0, 0.0));
        let placed = joint_on_screw(&base_from_joint, &joint(JointKind::Revolute), &screw).unwrap();
        let axis = placed.rotation * Vector3::z();
        assert!((axis - Vector3::z()).norm() < ROUNDING, "{axis}");
        let moment = -axis.cross(&placed.translation);
        assert!((moment - screw.linear).norm() < ROUNDING, "{moment}");
        // As little as possible: the height of the origin stays.
        assert!((placed.translation.z - base_from_joint.translation.z).abs() < ROUNDING);
    }

    #[test]
    fn a_joint_cannot_move_the_other_way_or_less_than_its_variable() {
        let here = Pose::identity();
        let placed = |twist: Twist, kind| joint_on_screw(&here, &joint(kind), &twist).is_some();
        let turn = |by: f64| Twist { angular: by * Vector3::z(), linear: Vector3::zeros() };
        assert!(placed(turn(1.0), JointKind::Revolute));
        assert!(!placed(turn(-1.0), JointKind::Revolute));
        assert!(!placed(turn(0.5), JointKind::Continuous));
        assert!(!placed(turn(1.0), JointKind::Prismatic));
        assert!(placed(Twist::shift(Vector3::z()), JointKind::Prismatic));
    }
}
