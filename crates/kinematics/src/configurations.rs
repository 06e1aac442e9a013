//! Configurations at which two models are compared without motion.

use congruent_description::{Joint, JointIndex, JointKind, Robot, RobotQ};

use crate::uniform::Uniform;

/// Position of a single revolute joint in an axis step, rad: 10 degrees.
const AXIS_STEP_RAD: f64 = std::f64::consts::PI / 18.0;
/// Position of a single prismatic joint in an axis step, m.
const AXIS_STEP_M: f64 = 0.01;
/// How far from zero a joint that slides without a range is sampled, m. Kind: choice; about the size of an arm.
pub const UNRANGED_SLIDE_M: f64 = 1.0;

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

/// The limits of a joint; one turn of a joint that turns without limits, and [`UNRANGED_SLIDE_M`] in both directions of one that
/// slides without. Of a range with one end the part of this width at that end.
///
/// # Examples
/// ```
/// use congruent_description::parse_urdf;
/// use congruent_kinematics::range;
/// let robot = parse_urdf("<robot name='r' version='1.2'><link name='a'/><link name='b'/><joint name='z' type='prismatic'>
///     <parent link='a'/><child link='b'/><limit lower='0.5'/></joint></robot>").unwrap();
/// assert_eq!(range(robot.joint(robot.movable_joints()[0])), (0.5, 2.5));
/// ```
pub fn range(joint: &Joint) -> (f64, f64) {
    let end = if joint.kind.is_angular() { std::f64::consts::PI } else { UNRANGED_SLIDE_M };
    let (lower, upper) = joint.position_range().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => (lower, upper),
        (true, false) => (lower, lower + 2.0 * end),
        (false, true) => (upper - 2.0 * end, upper),
        (false, false) => (-end, end),
    }
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
