//! The origin and the axis of each joint that are others in the other description, and a robot with them corrected.

use congruent_description::{Joint, JointIndex, LinkIndex, Robot};
use congruent_kinematics::Pose;
use nalgebra::{Isometry3, Unit, Vector3};

use crate::MatchedRobots;

/// An axis of a smaller turn has no direction. Unit: rad; kind: rounding.
const NO_TURN: f64 = 1e-12;

/// A part of a joint that places it: origin or axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointPart {
    /// Its `<origin>`: pose in the parent link.
    Origin(Isometry3<f64>),
    /// Its `<axis>`, in the joint's frame.
    Axis(Unit<Vector3<f64>>),
}

/// The part of a joint that is another one, as it is expected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointCorrection {
    /// The joint of the robot.
    pub joint: JointIndex,
    /// What the other description has in place of it.
    pub expected: JointPart,
    /// How far it moves a link about, m.
    pub size_m: f64,
}

/// All parts of joints that differ by more than rounding, from the root on.
pub(super) fn corrections(robots: &MatchedRobots<'_>) -> Vec<JointCorrection> {
    let reach_m = robots.reach_m();
    let of_joint =
        |joint: &Joint| [origin(robots, joint, reach_m), axis(robots, joint, reach_m)].into_iter().flatten();
    robots.robot.joints().iter().flat_map(of_joint).collect()
}

/// The origin of a joint in the other description. If that description lacks links of fixed joints before it, the
/// fault may be at one of those instead.
fn origin(robots: &MatchedRobots<'_>, joint: &Joint, reach_m: f64) -> Option<JointCorrection> {
    if !robots.is_matched(joint.child) {
        return None;
    }
    // Its own joint there says exactly what the file has; otherwise what all joints between the two links make
    // together.
    let expected = match robots.same_joint(joint) {
        Some(there) => there.parent_from_joint,
        None => (robots.there(joint.parent).inverse() * robots.there(joint.child)).to_isometry(),
    };
    let size_m = distance_m(&joint.parent_from_joint, &expected, reach_m);
    let index = robots.robot.parent_joint(joint.child)?;
    let correction = JointCorrection { joint: index, expected: JointPart::Origin(expected), size_m };
    (size_m > NO_TURN).then(|| at_differing_fixed_joint(robots, joint, correction))
}

/// Moves the correction to the fixed joint whose origin differs from that of its namesake, among the joints between
/// the same two links of the other description.
fn at_differing_fixed_joint(
    robots: &MatchedRobots<'_>,
    joint: &Joint,
    correction: JointCorrection,
) -> JointCorrection {
    let differs = |of: &Joint| {
        let there = robots.namesake(of)?;
        (distance_m(&of.parent_from_joint, &there.parent_from_joint, 1.0) > NO_TURN).then_some(())
    };
    if robots.same_joint(joint).is_some() || differs(joint).is_some() {
        return correction;
    }
    let mut before = between(robots, joint.parent);
    let named = before.find(|(_, fixed)| differs(fixed).is_some());
    named.map_or(correction, |(index, _)| moved_to(index, joint, robots, correction))
}

/// The same correction at a fixed joint before it.
pub(super) fn moved_to(
    index: JointIndex,
    joint: &Joint,
    robots: &MatchedRobots<'_>,
    correction: JointCorrection,
) -> JointCorrection {
    let JointPart::Origin(expected) = correction.expected else { return correction };
    let fixed = robots.robot.joint(index);
    let before_fixed = robots.own(fixed.parent);
    let parent = before_fixed.inverse() * robots.own(joint.parent);
    // The correction acts behind the joint. Moved before it, it is the same displacement expressed in the frame of
    // the fixed joint's parent.
    let corrected =
        parent * Pose::from(expected) * Pose::from(joint.parent_from_joint).inverse() * parent.inverse();
    let origin = (corrected * Pose::from(fixed.parent_from_joint)).to_isometry();
    JointCorrection { joint: index, expected: JointPart::Origin(origin), ..correction }
}

/// The fixed joints from a link towards the root whose links the other description lacks.
pub(super) fn between<'a>(
    robots: &MatchedRobots<'a>,
    mut link: LinkIndex,
) -> impl Iterator<Item = (JointIndex, &'a Joint)> {
    std::iter::from_fn(move || {
        let index = robots.unmatched_joint(link)?;
        let joint = robots.robot.joint(index);
        link = joint.parent;
        Some((index, joint))
    })
}

/// The axis of a moving joint in the other description.
fn axis(robots: &MatchedRobots<'_>, joint: &Joint, reach_m: f64) -> Option<JointCorrection> {
    let there = robots.namesake(joint).filter(|_| joint.kind.is_movable())?;
    let [found, expected] = [joint.axis_in_joint, there.axis_in_joint];
    // Sine alone would be zero for the opposite axis, `1 - cosine` alone loses small angles in rounding.
    let turn = found.cross(&expected).norm() + (1.0 - found.dot(&expected));
    let expected = JointPart::Axis(expected);
    let index = robots.robot.parent_joint(joint.child)?;
    (turn > NO_TURN).then_some(JointCorrection { joint: index, expected, size_m: turn * reach_m })
}

/// How far a pose at the end of a lever is from another one.
fn distance_m(one: &Isometry3<f64>, other: &Isometry3<f64>, lever_m: f64) -> f64 {
    let [one, other] = [one, other].map(|pose| Pose::from(*pose));
    one.distance_m(&other) + one.angle_rad(&other) * lever_m
}

/// The robot with these parts of joints corrected.
pub(super) fn corrected(robot: &Robot, corrections: &[JointCorrection]) -> Robot {
    robot.with_joints(|joint| {
        // By name: the robot that is changed has joints of its own.
        for correction in corrections.iter().filter(|of| robot.joint(of.joint).name == joint.name) {
            match correction.expected {
                JointPart::Origin(origin) => joint.parent_from_joint = origin,
                JointPart::Axis(axis) => joint.axis_in_joint = axis,
            }
        }
    })
}
