//! Conditions that hold in every state: rotations of links, of model and twin, are orthonormal with determinant 1, links are
//! where the joints between them allow, and joint states are finite numbers.

use congruent_description::{LinkIndex, Robot};
use congruent_input::{Quantity, SiUnit};
use congruent_kinematics::Pose;
use congruent_scenario::InvariantsCheck;
use nalgebra::Isometry3;

use super::joint_constraints::{ConstraintError, JointConstraint};
use crate::{
    CheckContext, Names,
    monitor::{Monitor, Observed},
    sample::{PoseChange, Sample},
    verdict::{Bound, InstantValue},
    watch::Watch,
};

/// Largest error of a rotation if a check gives none, for each joint of the longest chain, of which there are at least
/// eight: 4e-14 for arms. No unit; kind: rounding of products along a chain. Worst seen: 2.0e-15 for each joint (seven joints,
/// 24,000 steps), 1.9e-15 (45 joints); x2.5.
const ROTATION_OF_JOINT: f64 = 5e-15;
const FEWEST_JOINTS: usize = 8;

/// The default limit of rotations for a robot: rounding grows with the number of joints in a row.
pub(crate) fn default_rotation(robot: &Robot) -> f64 {
    let joints_to = |link: LinkIndex| {
        let above = std::iter::successors(robot.parent_joint(link), |&joint| {
            robot.parent_joint(robot.joint(joint).parent)
        });
        above.filter(|&joint| robot.joint(joint).kind.is_movable()).count()
    };
    let longest = robot.link_indices().map(joints_to).max().unwrap_or(0);
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 joints")]
    let joints = longest.max(FEWEST_JOINTS) as f64;
    joints * ROTATION_OF_JOINT
}

/// Largest error of the joints of the twin, m and rad. Kind: rounding of products along a chain and of its angles; worst
/// seen in the scenarios: see `docs/checks.md`.
const JOINT_ERROR: f64 = 1e-12;

pub(crate) struct InvariantsMonitor {
    constraints: Vec<JointConstraint>,
    offset: Watch,
    tilt: Watch,
    orthonormality: Watch,
    determinant: Watch,
    not_finite: Watch,
    samples: u64,
}

impl InvariantsMonitor {
    pub(crate) fn new(check: &InvariantsCheck, context: &CheckContext<'_>) -> Self {
        let limit = check.rotation.unwrap_or_else(|| default_rotation(&context.description.robot));
        let watch =
            |quantity, limit| Watch::new(quantity, SiUnit::Ratio, Bound::AtMost, limit, context.dof());
        let of_joints =
            |quantity, unit| Watch::new(quantity, unit, Bound::AtMost, JOINT_ERROR, context.dof());
        Self {
            constraints: JointConstraint::all(&context.description.robot),
            offset: of_joints(Quantity::JointOffset, SiUnit::Metre),
            tilt: of_joints(Quantity::JointTilt, SiUnit::Radian),
            orthonormality: watch(Quantity::OrthonormalityError, limit),
            determinant: watch(Quantity::DeterminantError, limit),
            not_finite: watch(Quantity::NotFiniteValues, 0.0),
            samples: 0,
        }
    }

    fn observe_rotation(&mut self, pose: &Pose, link: usize, sample: &Sample<'_>) {
        // 0 for a finite position, NaN otherwise: the rotation alone would not show a position that is not a number.
        let nothing = 0.0 * pose.translation.sum();
        self.orthonormality.observe(pose.orthonormality_error() + nothing, link, sample);
        self.determinant.observe((pose.determinant() - 1.0).abs() + nothing, link, sample);
    }

    fn observe_poses(&mut self, sample: &Sample<'_>) {
        if sample.change == PoseChange::AsBefore {
            for watch in [&mut self.orthonormality, &mut self.determinant, &mut self.offset, &mut self.tilt] {
                watch.observe_again(sample.time_s);
            }
            return;
        }
        for (link, (model, twin)) in sample.model.iter().zip(sample.twin).enumerate() {
            self.observe_rotation(model, link, sample);
            // Quaternions that the physics integrates may drift from norm 1, and then describe no rotation.
            self.observe_rotation(&written_out(twin), link, sample);
        }
        for constraint in &self.constraints {
            let ConstraintError { offset_m, tilt_rad } = constraint.error(sample.twin);
            self.offset.observe(offset_m, constraint.link, sample);
            self.tilt.observe(tilt_rad, constraint.link, sample);
        }
    }
}

impl Monitor for InvariantsMonitor {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        self.samples += 1;
        self.observe_poses(sample);
        let states = [sample.joints.truth, Some(sample.joints.measured)];
        for joint in 0..sample.joints.measured.q.len() {
            let vectors = states.iter().flatten().flat_map(|state| [&state.q[..], state.qd, state.effort]);
            let values = vectors.filter_map(|vector| vector.get(joint));
            let not_finite: f64 = values.map(|value| if value.is_finite() { 0.0 } else { 1.0 }).sum();
            self.not_finite.observe(not_finite, joint, sample);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let link = |link: usize| names.links[link].clone();
        let joint = |joint: usize| names.joints[joint].clone();
        let measures = vec![
            self.orthonormality.measure(&names.joints, link),
            self.determinant.measure(&names.joints, link),
            self.offset.measure(&names.joints, link),
            self.tilt.measure(&names.joints, link),
            self.not_finite.measure(&names.joints, joint),
        ];
        Observed { samples: self.samples, measures, ..Observed::default() }
    }

    fn values(&self, time_s: f64, take: &mut dyn FnMut(InstantValue)) {
        [&self.offset, &self.tilt, &self.orthonormality, &self.determinant, &self.not_finite]
            .into_iter()
            .filter_map(|watch| watch.at(time_s))
            .for_each(take);
    }

    fn has_failed(&self) -> bool {
        let watches = [&self.orthonormality, &self.determinant, &self.offset, &self.tilt, &self.not_finite];
        watches.into_iter().any(Watch::is_violated)
    }
}

/// The rotation as a matrix, by the formula that does not divide by the quaternion's norm: a norm other than 1 then shows as
/// an error of the matrix.
fn written_out(isometry: &Isometry3<f64>) -> Pose {
    let rotation = isometry.rotation.to_rotation_matrix().into_inner();
    Pose::from_parts(rotation, isometry.translation.vector)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use congruent_description::parse_urdf;

    use super::*;

    /// A chain of so many turning joints, each followed by a fixed one.
    fn chain(joints: usize) -> Robot {
        let mut text = String::from("<robot name='chain'><link name='link0'/>");
        for joint in 0..2 * joints {
            let kind = ["continuous", "fixed"][joint % 2];
            let child = joint + 1;
            let _ = write!(
                text,
                "<link name='link{child}'/><joint name='joint{joint}' type='{kind}'><parent link='link{joint}'/>\
                 <child link='link{child}'/><axis xyz='0 0 1'/></joint>"
            );
        }
        parse_urdf(&(text + "</robot>")).unwrap()
    }

    #[test]
    fn the_limit_of_rotations_grows_with_the_joints_in_a_row() {
        for (joints, limit) in [(0, 4e-14), (6, 4e-14), (8, 4e-14), (45, 45.0 * 5e-15)] {
            let found = default_rotation(&chain(joints));
            assert!((found - limit).abs() < 1e-24, "{joints}: {found}");
        }
    }
}
