//! A modest motion of a chain: where it starts, where it goes, how long it takes.

use congruent_description::{Joint, JointKind, Robot, RobotDescription, RobotQ};
use congruent_dynamics::{JointDynamics, TreeDynamics};
use congruent_kinematics::random_configurations;

/// Starts that are tried: 0, the middle of all ranges, and random ones, of which the first half keeps the joints that
/// do not move at 0.
const STARTS: usize = 400;
/// Share of an effort limit that gravity may take.
const HELD: f64 = 0.6;
/// Share of a joint's range that is left free at each end.
const MARGIN: f64 = 0.1;
/// Share of a joint's range that it moves at most.
const SHARE: f64 = 0.2;
/// A joint that turns moves at most this far.
const MOST_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// A joint that slides moves at most this far.
const MOST_M: f64 = 0.05;
/// Share of the limits of velocity, acceleration and jerk that the motion uses at most.
const EFFORT: f64 = 0.4;
/// No motion is shorter.
const LEAST_S: f64 = 1.5;

/// A motion of some joints to a target and back.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointMove {
    pub(super) start: RobotQ,
    pub(super) target: RobotQ,
    /// Coordinates that move, as indices of configuration vectors (`Robot::movable_joints` order).
    pub(super) moving: Vec<usize>,
    /// Time from the start to the target, and as long back.
    pub(super) duration_s: f64,
    /// Whether the actuators can hold the robot against gravity at both ends.
    pub(super) is_held: bool,
}

impl JointMove {
    /// The configuration at a share of the path, 0 at the start, 1 at the target.
    pub(super) fn at(&self, robot: &Robot, share: f64) -> RobotQ {
        let mut q = self.start.clone();
        for (coordinate, q) in q.iter_mut().enumerate() {
            *q += share * (self.target[coordinate] - *q);
        }
        robot.apply_mimic(&mut q);
        q
    }

    /// The same start with a motion of another size, as a share of the largest.
    pub(super) fn scaled(&self, robot: &Robot, size: f64) -> Self {
        let is_held = self.is_held;
        Self { is_held, ..Self::from(robot, self.start.clone(), self.moving.clone(), size) }
    }

    fn from(robot: &Robot, start: RobotQ, moving: Vec<usize>, size: f64) -> Self {
        let mut target = start.clone();
        let mut duration_s = LEAST_S;
        for &coordinate in &moving {
            let joint = joint_of(robot, coordinate);
            let (lower, upper) = inner_range(joint);
            // The inner range lacks `MARGIN` at both ends; divided by what remains, `SHARE` is one of the whole
            // range.
            let most = if joint.kind == JointKind::Prismatic { MOST_M } else { MOST_RAD };
            let distance = size * most.min(SHARE / (1.0 - 2.0 * MARGIN) * (upper - lower));
            let (up, down) = (upper - start[coordinate], start[coordinate] - lower);
            // Towards the farther end of the range, where there is more room.
            let signed = if up >= down { distance.min(up) } else { -distance.min(down) };
            target[coordinate] = rounded(joint, start[coordinate] + signed);
            let distance = (target[coordinate] - start[coordinate]).abs();
            duration_s = duration_s.max(least_s(joint, distance));
        }
        robot.apply_mimic(&mut target);
        // Tenths of a second are enough.
        Self { start, target, moving, duration_s: (duration_s * 10.0).ceil() / 10.0, is_held: false }
    }
}

/// Motions of the chain, first those that the actuators can hold, and of these the plainest first; none if no joint of the
/// chain can move.
pub(super) fn moves(description: &RobotDescription) -> Vec<JointMove> {
    let robot = &description.robot;
    let has_room = |joint: &Joint| {
        joint.mimic.is_none() && joint.position_range().is_none_or(|(lower, upper)| lower < upper)
    };
    let coordinates = description.moving_coordinates().into_iter();
    let moving: Vec<usize> = coordinates.filter(|&at| has_room(joint_of(robot, at))).collect();
    if moving.is_empty() {
        return Vec::new();
    }
    let zero = RobotQ::zeros(robot.dof());
    let middle: RobotQ = robot.movable_joints().iter().map(|&joint| middle(robot.joint(joint))).collect();
    let random = random_configurations(robot, 0, STARTS - 2);
    let starts = [zero, middle].into_iter().chain(random).enumerate().map(|(at, mut q)| {
        for (coordinate, q) in q.iter_mut().enumerate() {
            let joint = joint_of(robot, coordinate);
            let is_moving = moving.contains(&coordinate);
            let wanted = if is_moving || at >= STARTS / 2 { *q } else { 0.0 };
            // If the width of a range is not finite, neither is a random value in it.
            let wanted = if wanted.is_finite() { wanted } else { 0.0 };
            let (lower, upper) = if is_moving { inner_range(joint) } else { range(joint) };
            *q = rounded(joint, wanted.clamp(lower, upper));
        }
        robot.apply_mimic(&mut q);
        q
    });
    let mut gravity = TreeDynamics::new(robot);
    let mut moves: Vec<JointMove> = starts
        .map(|start| JointMove::from(robot, start, moving.clone(), 1.0))
        .map(|motion| JointMove { is_held: is_held(robot, &mut gravity, &motion), ..motion })
        .collect();
    // Stable: within both groups the plainest start, zero, stays first.
    moves.sort_by_key(|motion| !motion.is_held);
    moves
}

fn is_held(robot: &Robot, gravity: &mut TreeDynamics, motion: &JointMove) -> bool {
    let mut tau = vec![0.0; robot.dof()];
    let mut holds = |q: &RobotQ| {
        let is_known = gravity.gravity_into(q, &mut tau).is_ok();
        let within = |(&tau, coordinate): (&f64, usize)| {
            let effort = joint_of(robot, coordinate).limit.and_then(|limit| limit.effort);
            effort.filter(|&effort| effort > 0.0).is_none_or(|effort| tau.abs() <= HELD * effort)
        };
        is_known && tau.iter().zip(0..).all(within)
    };
    holds(&motion.start) && holds(&motion.target)
}

fn joint_of(robot: &Robot, coordinate: usize) -> &Joint {
    robot.joint(robot.movable_joints()[coordinate])
}

/// The limits of a joint, or half a turn or 1 m to both sides; of a range without end the part around 0.
fn range(joint: &Joint) -> (f64, f64) {
    /// No motion needs more, in rad or m.
    const WIDEST: f64 = 20.0;
    let (lower, upper) = congruent_kinematics::range(joint);
    let near = 0.0_f64.clamp(lower, upper);
    (lower.max(near - WIDEST), upper.min(near + WIDEST))
}

fn middle(joint: &Joint) -> f64 {
    let (lower, upper) = range(joint);
    f64::midpoint(lower, upper)
}

/// The limits with a margin at each end.
fn inner_range(joint: &Joint) -> (f64, f64) {
    let (lower, upper) = range(joint);
    let margin = MARGIN * (upper - lower);
    (lower + margin, upper - margin)
}

/// To a tenth of a degree or of a millimetre, if that is within the limits.
fn rounded(joint: &Joint, value: f64) -> f64 {
    let unit = if joint.kind == JointKind::Prismatic { 1e-4 } else { 0.1_f64.to_radians() };
    let near = (value / unit).round() * unit;
    let (lower, upper) = range(joint);
    if (lower..=upper).contains(&near) { near } else { value }
}

/// The time of a quintic move within a share of the limits that a scenario takes from the velocity limit: its largest
/// velocity is 1.875 s/T, its acceleration 5.78 s/T^2, its jerk 60 s/T^3.
fn least_s(joint: &Joint, distance: f64) -> f64 {
    let velocity = joint.limit.and_then(|limit| limit.velocity).filter(|&velocity| velocity > 0.0);
    let Some(velocity) = velocity else { return LEAST_S };
    let (acceleration, jerk) = (velocity / 0.25, velocity / 0.025);
    // Quintic s(x) = 10 x^3 - 15 x^4 + 6 x^5 with x = t/T: largest s' = 15/8 at x = 1/2, s'' = 10/sqrt(3), s''' =
    // 60 at the ends (Lynch & Park, ch. 9). The longest of the three times keeps all limits.
    let by_velocity = 1.875 * distance / (EFFORT * velocity);
    let by_acceleration = (5.78 * distance / (EFFORT * acceleration)).sqrt();
    let by_jerk = libm::cbrt(60.0 * distance / (EFFORT * jerk));
    by_velocity.max(by_acceleration).max(by_jerk)
}
