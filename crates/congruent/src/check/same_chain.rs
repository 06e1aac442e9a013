//! Whether two descriptions place their joints alike: then they are one chain, whose masses are worth comparing.

use congruent_agreement::{
    SourcePair,
    compare::{Agreement, CheckError, CheckReport},
};
use congruent_description::{Robot, RobotDescription, RobotQ, Tolerance};
use congruent_input::display::length_and_angle;
use congruent_kinematics::{LinkPoses, LinkPosesError, Pose, PoseError, Uniform, UrdfTree, range};

use super::poses_of_other::{POSITIONS, PosesOfOther};

/// Poses that differ by a smaller share of the reach, or by a smaller angle, are those of one chain: its masses and limits are worth
/// comparing. Kind: choice; six digits in a file give a hundredth of it.
const NEARLY: f64 = 1e-4;

/// A joint whose origin is off by no more, as a share of the reach, is that joint with a fault: the links behind it have the masses that
/// are written in their frames. Kind: choice; a frame that is chosen otherwise is a quarter turn away, or centimetres along an axis.
const SMALL_FAULT: f64 = 0.02;
/// The same of its direction, rad: three degrees.
const SMALL_FAULT_RAD: f64 = 0.055;

/// Links whose frames lie elsewhere in the other description, if all links move alike otherwise: then each differs from
/// the one of its name by the same transform at all positions. Empty if one does not.
pub(super) fn moved_alike(
    [robot, other]: [&Robot; 2],
    tolerance: &Tolerance,
    seed: u64,
) -> Result<Vec<String>, CheckError> {
    let (own, mut of_other) = (UrdfTree::new(robot), PosesOfOther::new(robot, other));
    let mut poses = [robot, robot].map(|robot| vec![Pose::identity(); robot.links().len()]);
    let mut at = |q: &RobotQ| -> Result<Vec<Pose>, LinkPosesError> {
        let [here, there] = &mut poses;
        own.root_from_links_into(q, here)?;
        of_other.root_from_links_into(q, there)?;
        Ok(here.iter().zip(there.iter()).map(|(here, there)| there.inverse() * *here).collect())
    };
    let moving: Vec<usize> =
        robot.movable_joints().iter().map(|&joint| robot.joint(joint).child.get()).collect();
    let at_zero = at(&RobotQ::zeros(robot.dof()))?;
    // If a link moves alike, its pose in the link of the same name is constant: it must be at random positions what
    // it is at zero.
    let mut random = Uniform::seeded(seed);
    for _ in 0..POSITIONS {
        let q = robot.movable_joints().iter().map(|&joint| {
            let (lower, upper) = range(robot.joint(joint));
            random.between(lower, upper)
        });
        let there_from_here = at(&q.collect())?;
        let is_other =
            |link: &usize| !PoseError::between(&at_zero[*link], &there_from_here[*link]).is_within(tolerance);
        if moving.iter().any(is_other) {
            return Ok(Vec::new());
        }
    }
    let elsewhere =
        |link: &&usize| !PoseError::between(&Pose::identity(), &at_zero[**link]).is_within(tolerance);
    Ok(moving.iter().filter(elsewhere).map(|&link| robot.links()[link].name.clone()).collect())
}

/// The difference of poses that is none of the two: within the tolerance, or within the digits if these have decided.
pub(super) fn tolerated(description: &RobotDescription, geometry: &CheckReport) -> Tolerance {
    let compared = geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther);
    let agreeing = compared.filter(|of| of.verdict == Agreement::Agree);
    let errors = agreeing.into_iter().flat_map(|of| &of.links).map(|link| link.error);
    let Tolerance { position_m, orientation_rad } = nearly_same(description);
    let least = PoseError { position_m, orientation_rad };
    let PoseError { position_m, orientation_rad } = errors.fold(least, PoseError::larger);
    Tolerance { position_m, orientation_rad }
}

/// What poses of one chain may differ by for masses and limits to be compared: the tolerance, or a ten thousandth of the reach.
pub(super) fn nearly_same(description: &RobotDescription) -> Tolerance {
    share_of_reach(description, NEARLY, NEARLY)
}

/// A share of the reach and an angle, or the tolerance if it is more.
fn share_of_reach(description: &RobotDescription, share: f64, angle_rad: f64) -> Tolerance {
    let Tolerance { position_m, orientation_rad } = description.tolerance;
    let reach_m = description.tolerance_scale().reach_m().unwrap_or_default();
    Tolerance { position_m: position_m.max(share * reach_m), orientation_rad: orientation_rad.max(angle_rad) }
}

/// The first joint, from the base on, whose link is elsewhere.
pub(super) fn misplaced_joint(
    robot: &Robot,
    geometry: &CheckReport,
    tolerance: &Tolerance,
) -> Option<String> {
    let comparison = geometry.comparisons.iter().find(|of| of.name == SourcePair::UrdfOther)?;
    let first = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).find_map(|joint| {
        let worst = &comparison.links[joint.child.get()];
        (!worst.error.is_within(tolerance)).then_some((joint, worst))
    });
    first.map(|(joint, worst)| {
        format!(
            "the two are not the same chain within the tolerance: link \"{}\" of joint \"{}\" is the first whose \
             pose differs, by up to {}",
            worst.link,
            joint.name,
            length_and_angle(worst.error.position_m, worst.error.orientation_rad)
        )
    })
}

/// What a joint may be off for the links behind it to be compared as they are written: a small fault.
pub(super) fn within_small_fault(description: &RobotDescription) -> Tolerance {
    share_of_reach(description, SMALL_FAULT, SMALL_FAULT_RAD)
}
