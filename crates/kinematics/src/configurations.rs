//! Configurations at which two models are compared without motion.

use congruent_description::{Joint, JointIndex, JointKind, Robot, RobotQ};

use crate::uniform::Uniform;

/// Position of a single revolute joint in an axis step, rad: 10 degrees.
const AXIS_STEP_RAD: f64 = std::f64::consts::PI / 18.0;
/// Position of a single prismatic joint in an axis step, m.
const AXIS_STEP_M: f64 = 0.01;

/// Zero, one axis at a time, `random` seeded draws within the limits, and the limits themselves:
/// each joint alone at both ends with the others half way, then all at their lower and upper ends.
pub fn sample_configurations(robot: &Robot, seed: u64, random: usize) -> Vec<RobotQ> {
    let joints: Vec<&Joint> = robot.movable_joints().iter().map(|&joint| robot.joint(joint)).collect();
    let mut configurations = vec![RobotQ::zeros(joints.len())];
    configurations.extend(axis_steps(robot).into_iter().map(|step| step.q));
    configurations.extend(random_configurations(robot, seed, random));
    // One joint at its limit with the others half way: errors that grow with a joint (signs, scales) are largest there, and the
    // others are away from zero, where many errors vanish.
    let middle: RobotQ = joints.iter().map(|joint| f64::midpoint(range(joint).0, range(joint).1)).collect();
    for (coordinate, joint) in joints.iter().enumerate().filter(|(_, joint)| joint.mimic.is_none()) {
        let (lower, upper) = range(joint);
        for end in [lower, upper] {
            let mut q = middle.clone();
            q[coordinate] = end;
            configurations.push(q);
        }
    }
    configurations.push(joints.iter().map(|joint| range(joint).0).collect());
    configurations.push(joints.iter().map(|joint| range(joint).1).collect());
    // Last, since mimic joints were set to their own limits above, which their masters need not allow.
    for q in &mut configurations {
        robot.apply_mimic(q);
    }
    configurations
}

/// One joint moved alone from zero.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisStep {
    /// The joint that is moved.
    pub joint: JointIndex,
    /// Its position: 10 degrees or 10 mm.
    pub by: f64,
    /// The configuration; joints that mimic this one follow it.
    pub q: RobotQ,
}

/// Each joint that mimics no other moved alone, in the robot's order.
pub fn axis_steps(robot: &Robot) -> Vec<AxisStep> {
    let step = |(coordinate, &joint): (usize, &JointIndex)| {
        let by = if robot.joint(joint).kind == JointKind::Prismatic { AXIS_STEP_M } else { AXIS_STEP_RAD };
        let mut q = RobotQ::zeros(robot.dof());
        q[coordinate] = by;
        robot.apply_mimic(&mut q);
        AxisStep { joint, by, q }
    };
    let moves_itself = |(_, joint): &(usize, &JointIndex)| robot.joint(**joint).mimic.is_none();
    robot.movable_joints().iter().enumerate().filter(moves_itself).map(step).collect()
}

/// Seeded draws within the limits; mimic joints follow their masters.
pub fn random_configurations(robot: &Robot, seed: u64, count: usize) -> Vec<RobotQ> {
    let mut random = Uniform::seeded(seed);
    let mut draw = |&joint: &JointIndex| {
        let (lower, upper) = range(robot.joint(joint));
        random.between(lower, upper)
    };
    let mut configuration = || {
        let mut q: RobotQ = robot.movable_joints().iter().map(&mut draw).collect();
        robot.apply_mimic(&mut q);
        q
    };
    (0..count).map(|_| configuration()).collect()
}

/// The limits of a joint, or one turn if it has none.
pub fn range(joint: &Joint) -> (f64, f64) {
    joint.position_range().unwrap_or((-std::f64::consts::PI, std::f64::consts::PI))
}

/// Moves each position that is outside its limits to the nearest limit; mimic joints follow.
pub fn move_inside_limits(q: &mut RobotQ, robot: &Robot) {
    for (&joint, q) in robot.movable_joints().iter().zip(q.iter_mut()) {
        if let Some((lower, upper)) = robot.joint(joint).position_range() {
            *q = q.clamp(lower, upper);
        }
    }
    robot.apply_mimic(q);
}
