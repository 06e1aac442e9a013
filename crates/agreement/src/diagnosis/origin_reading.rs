//! The other reading of a difference that takes several corrections of a table: the `<origin>` of one joint of the URDF is
//! off, in one number, in its rotation, in its translation, or in both. One moved joint changes up to four values of a
//! table.
//!
//! With the poses `A` before and `B` behind the joint's constant transform `S`, a tip `T` at every configuration wants
//! `A S' B = T`: the translation and the rotation of `S'` follow from each configuration alone, and their mean over all
//! is taken, so that the rounding of the table does not decide.

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, rotation_exp, rotation_log};
use nalgebra::{Matrix3, Vector3};

use super::{
    explanation::{Criterion, ExplainedFault, Explanation},
    hypothesis::{Cause, FaultPlace, ModelPair},
    thresholds::MAX_ORIGINS,
};

/// The joints of the reference model's file of which another origin makes the models agree, those first of which the
/// fewest numbers change; none of the others.
pub(super) fn origin_readings(models: &ModelPair, criterion: &Criterion) -> Vec<Explanation> {
    let joints = 0..models.reference.joints.len();
    let written = joints.filter(|&joint| models.reference.joints[joint].is_written);
    let mut found: Vec<(usize, Explanation)> =
        written.filter_map(|joint| reading(models, criterion, joint)).collect();
    found.sort_by_key(|(numbers, _)| *numbers);
    let fewest = found.first().map_or(0, |(numbers, _)| *numbers);
    let fewest_numbers = found.into_iter().filter(|(numbers, _)| *numbers == fewest);
    fewest_numbers.map(|(_, reading)| reading).take(MAX_ORIGINS).collect()
}

/// The fewest numbers of a joint's origin that make the models agree, and the models with them.
fn reading(models: &ModelPair, criterion: &Criterion, joint: usize) -> Option<(usize, Explanation)> {
    let wanted = WantedOrigin::new(models, criterion, joint)?;
    let own = wanted.own;
    let shifted = |shift: Vector3<f64>| Pose::from_parts(own.rotation, own.translation + shift);
    let axes = [0, 1, 2].map(|axis| (1, shifted(Vector3::ith(axis, wanted.shift[axis]))));
    let turned = Pose::from_parts(wanted.rotation, own.translation);
    let both = Pose::from_parts(wanted.rotation, own.translation + wanted.shift_if_turned);
    let others = [(3, turned), (3, shifted(wanted.shift)), (6, both)];
    let corrected = |origin: Pose| {
        let mut corrected = models.clone();
        corrected.reference.joints[joint].parent_from_joint = origin;
        corrected
    };
    let mut tried = axes.into_iter().chain(others).map(|(numbers, origin)| (numbers, corrected(origin)));
    let (numbers, corrected) = tried.find(|(_, corrected)| corrected.is_accepted(criterion))?;
    let residual = corrected.residual(criterion);
    let place = FaultPlace::ReferenceJoints(vec![joint]);
    let fault = ExplainedFault { cause: Cause::JointOrigin, place, free: Vec::new() };
    let stages = vec![models.residual(criterion), residual];
    Some((
        numbers,
        Explanation {
            faults: vec![fault],
            corrected,
            digits: criterion.digits.clone(),
            stages,
            residual,
            is_complete: true,
        },
    ))
}

/// The origin that the candidate wants of a joint.
struct WantedOrigin {
    own: Pose,
    /// The change of the translation if the rotation is kept.
    shift: Vector3<f64>,
    rotation: Matrix3<f64>,
    /// The change of the translation with that rotation.
    shift_if_turned: Vector3<f64>,
}

impl WantedOrigin {
    fn new(models: &ModelPair, criterion: &Criterion, joint: usize) -> Option<Self> {
        let own = models.reference.joints[joint].parent_from_joint;
        let at: Vec<OriginAt> =
            criterion.configurations.iter().map(|q| OriginAt::new(models, joint, q)).collect();
        let first = at.first()?.wanted_rotation();
        let turns = at.iter().map(|at| rotation_log(&(first.transpose() * at.wanted_rotation())));
        let rotation = first * rotation_exp(&mean(turns));
        Some(Self {
            own,
            shift: mean(at.iter().map(|at| at.wanted_shift(&own.rotation))),
            rotation,
            shift_if_turned: mean(at.iter().map(|at| at.wanted_shift(&rotation))),
        })
    }
}

/// What a joint's origin has to lead to at one configuration: `parent_from_joint` from `before` to `behind`.
struct OriginAt {
    /// The pose of the parent by the part of the chain that does not change.
    before: Pose,
    /// The pose of the tip in the joint.
    behind: Pose,
    /// The tip by the candidate, in the frame that `before` is in.
    wanted: Pose,
    own: Pose,
}

impl OriginAt {
    fn new(models: &ModelPair, joint: usize, q: &ChainQ) -> Self {
        let ModelPair { candidate, reference } = models;
        let (before, behind) = reference.around(joint, q);
        let (wanted, own) = (candidate.base_from_tip(q), reference.joints[joint].parent_from_joint);
        if reference.joints[joint].is_upward {
            // From child to parent: the inverse chain passes the origin in its own direction.
            return Self {
                before: behind.inverse(),
                behind: before.inverse(),
                wanted: wanted.inverse(),
                own,
            };
        }
        Self { before, behind, wanted, own }
    }

    fn wanted_rotation(&self) -> Matrix3<f64> {
        self.before.rotation.transpose() * self.wanted.rotation * self.behind.rotation.transpose()
    }

    /// The change of the translation after which the tips coincide, with this rotation of the origin.
    fn wanted_shift(&self, rotation: &Matrix3<f64>) -> Vector3<f64> {
        let origin = Pose::from_parts(*rotation, self.own.translation);
        let tip = self.before * origin * self.behind;
        self.before.rotation.transpose() * (self.wanted.translation - tip.translation)
    }
}

fn mean(values: impl Iterator<Item = Vector3<f64>>) -> Vector3<f64> {
    let (sum, count) = values.fold((Vector3::zeros(), 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / f64::max(count, 1.0)
}

#[cfg(test)]
mod tests {
    use congruent_description::Tolerance;
    use congruent_kinematics::Twist;
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::diagnosis::{CandidateModel, ReferenceJoint, ReferenceModel};

    /// Rounding of means of a hundred products; worst seen 2e-15 m or rad.
    const ROUNDING: f64 = 1e-13;

    fn turning(translation: [f64; 3], roll: f64) -> ReferenceJoint {
        ReferenceJoint {
            parent_from_joint: Pose::from_parts(
                rotation_exp(&Vector3::new(roll, 0.0, 0.0)),
                translation.into(),
            ),
            twist_in_joint: Some(Twist { angular: Vector3::z(), linear: Vector3::zeros() }),
            is_upward: false,
            is_written: true,
        }
    }

    #[test]
    fn a_moved_joint_is_found_in_one_number_or_in_all() {
        let joints = vec![
            turning([0.1, 0.0, 0.3], 0.2),
            turning([0.3, 0.1, 0.0], FRAC_PI_2),
            turning([0.25, 0.0, 0.1], -1.1),
            turning([0.0, 0.2, 0.1], 0.7),
        ];
        let right = ReferenceModel { joints };
        let candidate = CandidateModel::from_screws(&right.screws());
        let configurations: Vec<ChainQ> =
            (0..40).map(|k| (0..4).map(|j| libm::sin(f64::from(7 * k + 3 * j))).collect()).collect();
        let tolerance = Tolerance { position_m: 1e-9, orientation_rad: 1e-9 };
        let criterion = Criterion { tolerance, configurations, ..Criterion::default() };
        let number = Pose::from_parts(Matrix3::identity(), Vector3::new(0.0, 0.004, 0.0));
        let all =
            Pose::from_parts(rotation_exp(&Vector3::new(0.02, -0.1, 0.3)), Vector3::new(0.01, 0.02, -0.03));
        for (by, is_upward, numbers) in [(number, false, 1), (all, false, 6), (all, true, 6)] {
            let mut models = ModelPair { candidate: candidate.clone(), reference: right.clone() };
            let moved = &mut models.reference.joints[2];
            if is_upward {
                moved.parent_from_joint = moved.parent_from_joint.inverse();
                moved.is_upward = true;
            }
            let expected = moved.parent_from_joint;
            moved.parent_from_joint =
                Pose::from_parts(expected.rotation * by.rotation, expected.translation + by.translation);
            let found = origin_readings(&models, &criterion);
            let [found] = &found[..] else { panic!("{} readings", found.len()) };
            assert_eq!(found.faults[0].place, FaultPlace::ReferenceJoints(vec![2]));
            let origin = found.corrected.reference.joints[2].parent_from_joint;
            assert!(
                origin.distance_m(&expected) < ROUNDING && origin.angle_rad(&expected) < ROUNDING,
                "{origin:?}"
            );
            assert_eq!(reading(&models, &criterion, 2).map(|(numbers, _)| numbers), Some(numbers));
        }
    }
}
