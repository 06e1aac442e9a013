//! The differences of two chains in quantities that are invariant under a change of frames, the most
//! invariant quantity first. The first one that differs shows where to look.

use std::fmt;

use congruent_kinematics::{ScrewChain, Twist};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;

use super::{
    hypothesis::ModelPair,
    thresholds::{NO_TURN, PARALLEL, SAME_VALUE},
};

/// A quantity of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Invariant {
    /// 0 for a revolute joint, 1 for a prismatic joint.
    Kind,
    /// Turn or shift for one unit of the joint's variable.
    Ratio,
    /// Distance of a joint's axis and the next, m.
    AxisDistance,
    /// Angle between a joint's axis and the next one as undirected lines, rad.
    AxisAngle,
    /// Offset along a joint's axis between the common normals on both sides, m.
    Offset,
    /// Direction of an axis relative to the next one: the sign of the cosine of their angle.
    Sign,
    /// Angle about a joint's axis between the common normals on both sides, rad.
    Zero,
    /// Pose of the first axis: distance of the screws.
    Base,
    /// Pose of the tip behind the last axis: distance of the poses, m and rad together.
    Tool,
}

impl fmt::Display for Invariant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// One quantity in which two chains differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointDifference {
    /// The quantity that differs, with its unit.
    pub invariant: Invariant,
    /// The joint, from 0; of two or three consecutive axes the first.
    pub joint: usize,
    /// The value of the candidate; not a number if the candidate does not have the quantity.
    pub found: f64,
    /// The value of the reference model; not a number if it does not have the quantity.
    pub expected: f64,
}

/// All differences of the chains, the most invariant quantities first.
pub(crate) fn compare(models: &ModelPair) -> Vec<JointDifference> {
    let joints = models.reference.joint_count();
    // Both as screws: rows of a table and joints of a URDF have no quantities in common.
    let candidate = ScrewChain::identify(joints, |q| models.candidate.base_from_tip(q));
    let reference = models.reference.screws();
    let mut differences = Vec::new();
    let (found_here, expected_here) = (quantities(&candidate), quantities(&reference));
    let value = |list: &[QuantityOfJoint], at: usize, of: Invariant| {
        list.iter().find(|(joint, (kind, _))| (*joint, *kind) == (at, of)).map(|(_, (_, value))| *value)
    };
    for &(joint, (invariant, found)) in &found_here {
        // Quantities that one chain has and the other lacks, as for parallel axes, compare as not a number: `off >
        // ..` is false.
        let expected = value(&expected_here, joint, invariant).unwrap_or(f64::NAN);
        // Angles about an axis differ modulo one turn.
        let off = if invariant == Invariant::Zero {
            let turn = found - expected;
            libm::atan2(libm::sin(turn), libm::cos(turn)).abs()
        } else {
            (found - expected).abs()
        };
        // A joint that moves nothing in the other chain has no kind there.
        if off > SAME_VALUE || (expected.is_nan() && invariant == Invariant::Kind) {
            differences.push(JointDifference { invariant, joint, found, expected });
        }
    }
    for &(joint, (invariant, expected)) in &expected_here {
        if invariant == Invariant::Kind && value(&found_here, joint, invariant).is_none() {
            differences.push(JointDifference { invariant, joint, found: f64::NAN, expected });
        }
    }
    if let (Some(found), Some(expected)) =
        (candidate.twists_in_base.first(), reference.twists_in_base.first())
    {
        let off =
            libm::hypot((found.angular - expected.angular).norm(), (found.linear - expected.linear).norm());
        if off > SAME_VALUE {
            differences.push(JointDifference {
                invariant: Invariant::Base,
                joint: 0,
                found: off,
                expected: 0.0,
            });
        }
    }
    let (found, expected) = (candidate.base_from_tip_at_zero, reference.base_from_tip_at_zero);
    let off = libm::hypot(found.distance_m(&expected), found.angle_rad(&expected));
    if off > SAME_VALUE {
        let joint = joints.saturating_sub(1);
        differences.push(JointDifference { invariant: Invariant::Tool, joint, found: off, expected: 0.0 });
    }
    // By invariance first: a wrong axis distance says more than the tool pose that follows from it.
    differences.sort_by_key(|difference| (difference.invariant, difference.joint));
    differences
}

/// A joint's axis as a line; `through` is `None` for a prismatic joint.
struct JointAxisLine {
    direction: Vector3<f64>,
    through: Option<Vector3<f64>>,
    ratio: f64,
}

impl JointAxisLine {
    /// `None` for a joint that moves nothing.
    fn from_twist(twist: &Twist) -> Option<Self> {
        let Twist { angular, linear } = twist;
        let turn = angular.norm();
        if turn > NO_TURN {
            // w x v / w^2, the point of the axis nearest to the origin.
            let through = Some(angular.cross(linear) / (turn * turn));
            return Some(Self { direction: angular / turn, through, ratio: turn });
        }
        let shift = linear.norm();
        (shift > NO_TURN).then(|| Self { direction: linear / shift, through: None, ratio: shift })
    }

    /// Coordinate along this axis, from its point, of the common normal to `other`; `None` for parallel axes
    /// and prismatic joints.
    fn foot(&self, other: &Self) -> Option<f64> {
        let across = self.direction.cross(&other.direction);
        if across.norm() < PARALLEL {
            return None;
        }
        let between = other.through? - self.through?;
        Some(between.cross(&other.direction).dot(&across) / across.norm_squared())
    }

    fn distance(&self, other: &Self) -> Option<f64> {
        let across = self.direction.cross(&other.direction);
        let between = other.through? - self.through?;
        Some(if across.norm() < PARALLEL {
            between.cross(&self.direction).norm()
        } else {
            between.dot(&across).abs() / across.norm()
        })
    }
}

/// A quantity with the joint that it belongs to.
type QuantityOfJoint = (usize, (Invariant, f64));

/// All quantities that a chain has.
fn quantities(chain: &ScrewChain) -> Vec<QuantityOfJoint> {
    let axes: Vec<Option<JointAxisLine>> =
        chain.twists_in_base.iter().map(JointAxisLine::from_twist).collect();
    let mut list = Vec::new();
    for (joint, axis) in axes.iter().enumerate() {
        let Some(axis) = axis else { continue };
        list.push((joint, (Invariant::Kind, if axis.through.is_some() { 0.0 } else { 1.0 })));
        list.push((joint, (Invariant::Ratio, axis.ratio)));
        let Some(Some(next)) = axes.get(joint + 1) else { continue };
        let (sine, cosine) =
            (axis.direction.cross(&next.direction).norm(), axis.direction.dot(&next.direction));
        // As undirected lines; the direction is a quantity of its own, since a flipped axis is a fault of its own.
        list.push((joint, (Invariant::AxisAngle, libm::atan2(sine, cosine.abs()))));
        list.push((joint, (Invariant::Sign, if cosine.abs() < PARALLEL { 0.0 } else { cosine.signum() })));
        list.extend(axis.distance(next).map(|distance| (joint, (Invariant::AxisDistance, distance))));
        let Some(Some(last)) = axes.get(joint + 2) else { continue };
        if let (Some(before), Some(behind)) = (next.foot(axis), next.foot(last)) {
            // Without its sign, which depends on the direction of the axis.
            list.push((joint, (Invariant::Offset, (behind - before).abs())));
        }
        let normals = (axis.direction.cross(&next.direction), next.direction.cross(&last.direction));
        // Parallel axes have no common normal whose direction could be compared.
        if normals.0.norm() > PARALLEL && normals.1.norm() > PARALLEL {
            let sine = normals.0.cross(&normals.1).dot(&next.direction);
            list.push((joint, (Invariant::Zero, libm::atan2(sine, normals.0.dot(&normals.1)))));
        }
    }
    list
}
