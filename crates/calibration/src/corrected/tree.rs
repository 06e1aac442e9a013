//! The corrected tree: origins of joints between base and tip, and a link for the frame in which the rows were measured.

use std::collections::BTreeMap;

use congruent_description::{JointIndex, JointRounding, Link, Robot, RobotDescription};
use congruent_input::Diagnostic;
use congruent_kinematics::{Pose, ScrewTree};
use nalgebra::Isometry3;

use super::joint_on_screw::joint_on_screw;
use crate::{chain::NominalChain, codes, estimation::Displacements};

/// A pose that is nearer to the written one is that one: the file then keeps its digits. Kind: rounding of a dozen products within
/// 2 m, m and rad; `check` compares with 1e-12.
const UNCHANGED: f64 = 1e-14;

/// The nominal tree with the corrections of the arm, and the pose that its tip has at zero.
pub(super) struct CorrectedTree {
    pub(super) robot: Robot,
    /// In link `base`, whose own displacement is not in it.
    pub(super) base_from_tip_at_zero: Pose,
}

/// Moves the origins of the joints between base and tip so that the chain is the corrected one. Links, shapes, masses and limits
/// stay, and what hangs on a link moves with it.
///
/// # Errors
/// A joint of the tree cannot move as the model says.
pub(super) fn corrected_tree(
    description: &RobotDescription,
    nominal: &NominalChain<'_>,
    moved: &Displacements,
) -> Result<CorrectedTree, Diagnostic> {
    let robot = &description.robot;
    let homes = ScrewTree::new(robot);
    let base_from_root = homes.home(description.base).inverse();
    let chain = robot.chain(description.base, description.tip).unwrap_or_default();
    let mut origins: BTreeMap<JointIndex, Pose> = BTreeMap::new();
    // Of the link that the walk has reached, behind all corrections before it.
    let mut here = chain.first().map_or(base_from_root * *homes.home(description.tip), |&first| {
        base_from_root * *homes.home(robot.joint(first).parent)
    });
    let mut before = moved.slots[0];
    // The link of the last joint that moves, and the first joint behind it.
    let (mut last_body, mut behind) = (here, None);
    for &index in &chain {
        let joint = robot.joint(index);
        let Some(at) = row(nominal, robot, index) else {
            behind = behind.or(Some(index));
            here = here * Pose::from(joint.parent_from_joint);
            continue;
        };
        let base_from_joint = base_from_root * *homes.home(joint.child);
        let twist = &nominal.chain.twists_in_base[at];
        let placed =
            joint_on_screw(&base_from_joint, joint, twist).ok_or_else(|| other_motion(&joint.name))?;
        // The zero commutes with the joint: before it, the link of the joint turns with it.
        let corrected = before * moved.zeros[at] * placed;
        origins.insert(index, here.inverse() * corrected);
        before = before * moved.slots[at + 1];
        (here, last_body, behind) = (corrected, corrected, None);
    }
    let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
    let nominal_tip = nominal.chain.base_from_tip_at_zero * tip_from_tcp.inverse();
    if let Some(first) = behind {
        // The first fixed joint behind the last moving one has the corrections there, so that flange and tip move together.
        let first_child_from_tip =
            homes.home(robot.joint(first).child).inverse() * *homes.home(description.tip);
        let tip = before * nominal_tip;
        origins.insert(first, last_body.inverse() * tip * first_child_from_tip.inverse());
        here = tip;
    }
    Ok(CorrectedTree { robot: with_origins(robot, &origins), base_from_tip_at_zero: here })
}

/// The place of a moving joint in the chain; `None` for a fixed one.
fn row(nominal: &NominalChain<'_>, robot: &Robot, joint: JointIndex) -> Option<usize> {
    let coordinate = robot.coordinate(joint)?;
    nominal.coordinates.iter().position(|&each| each == coordinate)
}

fn with_origins(robot: &Robot, origins: &BTreeMap<JointIndex, Pose>) -> Robot {
    let by_name: BTreeMap<&str, &Pose> =
        origins.iter().map(|(&index, pose)| (robot.joint(index).name.as_str(), pose)).collect();
    robot.with_joints(|joint| {
        let Some(&origin) = by_name.get(joint.name.as_str()) else { return };
        if is_unchanged(origin, &joint.parent_from_joint) {
            return;
        }
        joint.parent_from_joint = origin.to_isometry();
        // The digits of the nominal file say nothing about the new value.
        joint.rounding = JointRounding::default();
    })
}

/// Whether a pose is the written one up to rounding.
pub(super) fn is_unchanged(pose: &Pose, written: &Isometry3<f64>) -> bool {
    let written = Pose::from(*written);
    pose.distance_m(&written) < UNCHANGED && pose.angle_rad(&written) < UNCHANGED
}

fn other_motion(joint: &str) -> Diagnostic {
    let message = format!("joint \"{joint}\" moves otherwise in the URDF than in the table");
    Diagnostic::error(codes::calibrate::OTHER_MOTION, message)
        .with_help("`congruent check` says how the two differ: correct that first, then calibrate")
}

/// The tree with a frame as a link of its own, and the name that it has there.
///
/// It hangs on the link, and the root stays: gravity and the links of the arm remain where they are.
pub(super) fn with_frame(robot: &Robot, link: &str, name: &str, link_from_frame: &Pose) -> (Robot, String) {
    let mut name = name.to_owned();
    while robot.find_link(&name).is_some() {
        name.push('_');
    }
    let frame = Link { name: name.clone(), ..Link::default() };
    (robot.with_fixed_link(link, link_from_frame.to_isometry(), frame), name)
}
