//! The sets of corrections that can be free: zeros, table entries, axes, base, tool.

use congruent_description::{DhConvention, DhRowKind, DhTable, RobotQ};
use congruent_kinematics::{Axes, DhChain, DhRowTwists, KinematicsError, Pose, ScrewChain, Twist};
use nalgebra::Vector3;

use super::correction_parameter::{CorrectionEntry, CorrectionParameter, rotates};

/// Neighbouring axes whose angle has a smaller sine count as nearly parallel: there `theta`, `d` and
/// `a` are ill-conditioned, and `beta` is added. 0.05 is 3 degrees, as usual in the literature.
const NEARLY_PARALLEL_SINE: f64 = 0.05;

/// The names of a rigid correction's entries: translations, then the rotations in the order in which they
/// compose, so that the six together are `xyz` and fixed-axis roll, pitch, yaw.
const RIGID: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];

/// The zero of each joint: `<joint>.zero`, in the joint's own unit and direction.
///
/// `joints` are the names in the chain's order.
pub fn zero_offsets(chain: &ScrewChain, joints: &[&str]) -> Vec<CorrectionParameter> {
    let zero = |(at, (twist, joint)): (usize, (&Twist, &&str))| CorrectionParameter {
        name: format!("{joint}.zero"),
        entry: CorrectionEntry::Zero,
        joint: Some(at),
        // Behind its joint: its own screw commutes with its motion, so either side would do.
        slot: at + 1,
        generator_in_base: *twist,
    };
    chain.twists_in_base.iter().zip(joints).enumerate().map(zero).collect()
}

/// The position and orientation of the base: `base.x` to `base.roll`, about the base's own axes.
pub fn base_pose() -> Vec<CorrectionParameter> {
    rigid(&Pose::identity(), "base", CorrectionEntry::Base, 0)
}

/// The position and orientation of the measured frame in the last link: `tool.x` to `tool.roll`.
pub fn tool_pose(chain: &ScrewChain) -> Vec<CorrectionParameter> {
    rigid(&chain.base_from_tip_at_zero, "tool", CorrectionEntry::Tool, chain.joint_count())
}

/// The axis of each joint, with everything behind it: two tilts about the point of the axis that is
/// nearest to the base, and for a revolute joint two shifts, across the axis.
///
/// The directions are the two axes of the base that are most nearly across the joint's, made
/// exactly so: `<joint>.tilt_x` is a rotation about nearly the base's x.
pub fn joint_axes(chain: &ScrewChain, joints: &[&str]) -> Vec<CorrectionParameter> {
    let mut parameters = Vec::with_capacity(4 * joints.len());
    for (slot, (twist, joint)) in chain.twists_in_base.iter().zip(joints).enumerate() {
        let is_revolute = rotates(twist);
        let axis = if is_revolute { twist.angular } else { twist.linear }.normalize();
        // Of a prismatic joint only the direction counts; it is tilted about the base's origin.
        // A screw with linear = -axis x point * rate: the point of the axis nearest to the origin is axis x
        // linear / rate.
        let point =
            if is_revolute { axis.cross(&twist.linear) / twist.angular.norm() } else { Vector3::zeros() };
        for (letter, across) in across(&axis) {
            if is_revolute {
                parameters.push(CorrectionParameter {
                    name: format!("{joint}.shift_{letter}"),
                    entry: CorrectionEntry::AxisShift,
                    joint: Some(slot),
                    slot,
                    generator_in_base: Twist::shift(across),
                });
            }
            parameters.push(CorrectionParameter {
                name: format!("{joint}.tilt_{letter}"),
                entry: CorrectionEntry::AxisTilt,
                joint: Some(slot),
                slot,
                generator_in_base: Twist::turn(across, &point),
            });
        }
    }
    parameters
}

/// The entries of a table: `<joint>.theta`, `.d`, `.a`, `.alpha`, and `.beta` if neighbouring axes
/// are nearly parallel. A correction is added to the table's entry, exactly.
///
/// `joints` are the names of the rows' joints, `dof` the robot's.
///
/// # Errors
/// [`KinematicsError`] never comes for a chain of this table and its robot.
pub fn dh_entries(
    table: &DhTable,
    chain: &DhChain,
    joints: &[&str],
    dof: usize,
) -> Result<Vec<CorrectionParameter>, KinematicsError> {
    let rows = table.rows.len();
    let mut base_from_dh = vec![Pose::identity(); rows + 1];
    chain.dh_frames_into(&RobotQ::zeros(dof), &mut base_from_dh)?;
    let mut parameters = Vec::with_capacity(5 * rows);
    for (at, (row, joint)) in table.rows.iter().zip(joints).enumerate() {
        // In the standard convention a and alpha act behind the joint of their row, in the modified one before
        // it.
        let (x_slot, has_neighbour) = match table.convention {
            DhConvention::Standard => (at + 1, at + 1 < rows),
            DhConvention::Modified => (at, at > 0),
        };
        let (before, behind) = (Axes::from_pose(&base_from_dh[at]), Axes::from_pose(&base_from_dh[at + 1]));
        let by = DhRowTwists::between(table.convention, &before, &behind);
        let mut push = |entry, word: &str, slot, generator_in_base| {
            let name = format!("{joint}.{word}");
            parameters.push(CorrectionParameter { name, entry, joint: Some(at), slot, generator_in_base });
        };
        // The entry that the coordinate is added to is preferred over the constant one: it is the zero of the
        // joint.
        let (theta, d) = match row.kind {
            DhRowKind::Revolute => (CorrectionEntry::JointEntry, CorrectionEntry::ConstantEntry),
            DhRowKind::Prismatic => (CorrectionEntry::ConstantEntry, CorrectionEntry::JointEntry),
        };
        push(theta, "theta", at + 1, by.theta);
        push(d, "d", at + 1, by.d);
        push(CorrectionEntry::A, "a", x_slot, by.a);
        push(CorrectionEntry::Alpha, "alpha", x_slot, by.alpha);
        if has_neighbour && libm::sin(row.alpha_rad).abs() < NEARLY_PARALLEL_SINE {
            let frame = &base_from_dh[x_slot];
            let y = frame.rotation.column(1).into_owned();
            push(CorrectionEntry::Beta, "beta", x_slot, Twist::turn(y, &frame.translation));
        }
    }
    Ok(parameters)
}

fn rigid(base_from_frame: &Pose, of: &str, entry: CorrectionEntry, slot: usize) -> Vec<CorrectionParameter> {
    let [roll, pitch, yaw, x, y, z] = Twist::units().map(|unit| unit.transformed_by(base_from_frame));
    let generators = [x, y, z, yaw, pitch, roll];
    let named = |(word, generator_in_base)| CorrectionParameter {
        name: format!("{of}.{word}"),
        entry,
        joint: None,
        slot,
        generator_in_base,
    };
    RIGID.into_iter().zip(generators).map(named).collect()
}

/// Two unit vectors across `axis` and each other, each with the letter of the base's axis that it
/// is nearest to.
fn across(axis: &Vector3<f64>) -> [(char, Vector3<f64>); 2] {
    const LETTERS: [char; 3] = ['x', 'y', 'z'];
    // The last of equals, so that an axis along x gives y and z in this order.
    let along = (0..3).fold(0, |best, at| if axis[at].abs() > axis[best].abs() { at } else { best });
    let first = usize::from(along == 0);
    let second = 3 - along - first;
    let mut unit = Vector3::zeros();
    unit[first] = 1.0;
    // Gram-Schmidt of a unit vector of the base; it cannot vanish, since `along` (the largest component) is
    // another one.
    let u = (unit - axis * axis[first]).normalize();
    let v = axis.cross(&u);
    // Both directions point along the positive axes of the base, so that a sign in a report can be read off the
    // letter.
    let v = if v[second] < 0.0 { -v } else { v };
    [(LETTERS[first], u), (LETTERS[second], v)]
}
