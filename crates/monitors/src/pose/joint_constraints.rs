//! Deviation of two links from the motion that the joint between them allows, at any position of the joint.

use congruent_description::{Joint, JointKind, Robot};
use nalgebra::Isometry3;

/// The joint that carries a link, as a constraint on the poses of the two links that it joins.
pub(super) struct JointConstraint {
    /// Index of the link that the joint carries.
    pub(super) link: usize,
    joint: Joint,
}

/// The error of a constraint.
pub(super) struct ConstraintError {
    /// Distance of the carried link's origin from the positions that the joint allows, m.
    pub(super) offset_m: f64,
    /// Angle between the carried link's orientation and those that the joint allows, rad.
    pub(super) tilt_rad: f64,
}

impl JointConstraint {
    pub(super) fn all(robot: &Robot) -> Vec<Self> {
        robot.joints().iter().map(|joint| Self { link: joint.child.get(), joint: joint.clone() }).collect()
    }

    /// Its error at poses of all links in one frame.
    pub(super) fn error(&self, root_from_links: &[Isometry3<f64>]) -> ConstraintError {
        let Joint { parent, child, kind, parent_from_joint, axis_in_joint, .. } = &self.joint;
        let parent_from_child = root_from_links[parent.get()].inv_mul(&root_from_links[child.get()]);
        let joint_from_child = parent_from_joint.inv_mul(&parent_from_child);
        let (shift, turn) = (joint_from_child.translation.vector, joint_from_child.rotation);
        let along = match kind {
            // The shift along its own axis is the joint's coordinate, which no constraint limits.
            JointKind::Prismatic => axis_in_joint.dot(&shift),
            _ => 0.0,
        };
        let offset_m = (shift - axis_in_joint.into_inner() * along).norm();
        let tilt_rad = match kind {
            JointKind::Fixed | JointKind::Prismatic => turn.angle(),
            // A rotation about the axis is the joint's own motion: only the direction of the axis is constrained.
            JointKind::Revolute | JointKind::Continuous => {
                let turned = turn * axis_in_joint;
                libm::atan2(turned.cross(axis_in_joint).norm(), turned.dot(axis_in_joint))
            }
        };
        ConstraintError { offset_m, tilt_rad }
    }
}

#[cfg(test)]
mod tests {
    use congruent_description::parse_urdf;
    use nalgebra::Vector3;

    use super::*;

    /// One joint of a kind, about or along z, 1 m up.
    fn constraint(kind: &str) -> JointConstraint {
        let text = format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="{kind}"><origin xyz="0 0 1"/>
               <parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
               <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#
        );
        JointConstraint::all(&parse_urdf(&text).unwrap()).swap_remove(0)
    }

    #[track_caller]
    fn is_off(kind: &str, pose: (Vector3<f64>, Vector3<f64>), expected: (f64, f64)) {
        let poses = [Isometry3::identity(), Isometry3::new(pose.0, pose.1)];
        let ConstraintError { offset_m, tilt_rad } = constraint(kind).error(&poses);
        assert!((offset_m - expected.0).abs() < 1e-15, "{kind}: {offset_m} m");
        assert!((tilt_rad - expected.1).abs() < 1e-15, "{kind}: {tilt_rad} rad");
    }

    #[test]
    fn a_joint_allows_its_own_motion_and_no_other() {
        let up = Vector3::z();
        is_off("fixed", (up, Vector3::zeros()), (0.0, 0.0));
        is_off("fixed", (up * 1.25, up * 0.5), (0.25, 0.5));
        is_off("revolute", (up, up * 0.5), (0.0, 0.0));
        is_off("continuous", (up * 1.25, Vector3::x() * 0.5), (0.25, 0.5));
        is_off("prismatic", (up * 1.25, Vector3::zeros()), (0.0, 0.0));
        is_off("prismatic", (up + Vector3::x() * 0.5, up * 0.25), (0.5, 0.25));
    }
}
