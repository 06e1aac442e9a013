//! An arm as inverse kinematics, workspace and manipulability see it: a chain from base to tool,
//! its independent joints and their ranges.

use std::f64::consts::{PI, TAU};

use congruent_description::{ArmQ, ChainQ, JointIndex, LinkIndex, Mimic, Robot, RobotDescription, RobotQ};

use super::spread::spread;
use crate::{
    chain::{jacobian::kind::JacobianKind, serial::chain::SerialChain},
    configurations::UNRANGED_SLIDE_M,
    error::KinematicsError,
    spatial::{pose::Pose, twist::Twist},
    uniform::Uniform,
};

/// Most joints of an arm for a search over its whole joint range. Kind: speed; the work grows with the third power of the joints. With 60
/// `sensitivity` takes 18 s, `workspace` 7 s; snake robots have some 30.
const MOST_SEARCHED_JOINTS: usize = 60;

/// One independent joint of an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmJoint {
    /// Index of the joint in the robot.
    pub joint: JointIndex,
    /// Index of its entry in the robot's configuration vector.
    pub coordinate: usize,
    /// Whether it turns, in rad; otherwise it slides, in m.
    pub turns: bool,
    /// Lower limit, rad or m; minus infinity without a limit.
    pub lower: f64,
    /// Upper limit, rad or m; infinity without a limit.
    pub upper: f64,
    /// Whether a full turn of the joint changes no pose: false if a mimic joint follows with a fractional multiplier.
    wraps: bool,
}

impl ArmJoint {
    /// The range from which positions are drawn: the limits, or one turn if there are none.
    pub fn sampled_range(&self) -> (f64, f64) {
        // One turn, or 2 m about zero, where nothing is declared.
        let (low, high) = if self.turns { (-PI, PI) } else { (-UNRANGED_SLIDE_M, UNRANGED_SLIDE_M) };
        match (self.lower.is_finite(), self.upper.is_finite()) {
            (true, true) => (self.lower, self.upper),
            (true, false) => (self.lower, self.lower + (high - low)),
            (false, true) => (self.upper - (high - low), self.upper),
            (false, false) => (low, high),
        }
    }

    /// `q` within the limits: a full turn further if that is inside, since it is the same pose,
    /// otherwise the nearest limit.
    #[inline]
    pub(crate) fn inside(&self, q: f64) -> f64 {
        if q > self.upper {
            // The fewest whole turns that bring the position below the upper limit.
            let turned = q - TAU * ((q - self.upper) / TAU).ceil();
            if self.wraps && turned >= self.lower { turned } else { self.upper }
        } else if q < self.lower {
            let turned = q + TAU * ((self.lower - q) / TAU).ceil();
            if self.wraps && turned <= self.upper { turned } else { self.lower }
        } else {
            q
        }
    }

    /// `q` moved by whole turns as near to `target` as the limits allow.
    pub(crate) fn nearest_turn(&self, q: f64, target: f64) -> f64 {
        if !self.wraps {
            return q;
        }
        let turns = ((target - q) / TAU).round();
        // If the nearest number of turns is outside the limits, one turn less is tried; otherwise `q`, which is inside, stays.
        [turns, turns - turns.signum()]
            .map(|turns| q + TAU * turns)
            .into_iter()
            .find(|candidate| (self.lower..=self.upper).contains(candidate))
            .unwrap_or(q)
    }
}

/// How a joint of the chain follows an independent one: `q = multiplier * q_independent + offset`.
#[derive(Debug, Clone, Copy)]
struct Follows {
    independent: usize,
    multiplier: f64,
    offset: f64,
}

/// A chain from link `base` to a tool centre point, driven by its independent joints.
///
/// Joints that mimic another follow it, and their limits bind it. Configurations `q` of an arm hold
/// one entry for each of [`Arm::joints`]. It owns the buffers of its calls, so these allocate nothing.
#[derive(Debug, Clone)]
pub struct Arm {
    chain: SerialChain,
    tip_from_tcp: Pose,
    joints: Vec<ArmJoint>,
    follows: Vec<Follows>,
    metres_per_rad: f64,
    /// The attainable ranks of its Jacobians, once they are known.
    pub(super) ranks: Option<[usize; 3]>,
    positions: ChainQ,
    of_chain: Vec<Twist>,
    columns: Vec<Twist>,
}

impl Arm {
    /// The arm of a loaded robot: its URDF chain from base to tip, and the tool if one is declared.
    ///
    /// # Errors
    /// [`KinematicsError::NoJoint`] if nothing moves between base and tip.
    pub fn from_description(description: &RobotDescription) -> Result<Self, KinematicsError> {
        let tip_from_tcp = description.tip_from_tcp.map_or(Pose::identity(), Pose::from);
        Self::new(&description.robot, description.base, description.tip, tip_from_tcp)
    }

    /// The arm from link `base` to a tool in link `tip`.
    ///
    /// # Errors
    /// [`KinematicsError::NoJoint`] if nothing moves between the two.
    pub fn new(
        robot: &Robot,
        base: LinkIndex,
        tip: LinkIndex,
        tip_from_tcp: Pose,
    ) -> Result<Self, KinematicsError> {
        let chain = SerialChain::from_urdf(robot, base, tip);
        let (mut joints, mut follows) = (Vec::new(), Vec::new());
        for &coordinate in chain.coordinates() {
            follow(robot, robot.movable_joints()[coordinate], &mut joints, &mut follows);
        }
        if joints.is_empty() {
            return Err(KinematicsError::NoJoint);
        }
        let mut arm = Self {
            positions: ChainQ::zeros(follows.len()),
            of_chain: vec![Twist::zero(); follows.len()],
            columns: vec![Twist::zero(); joints.len()],
            chain,
            tip_from_tcp,
            joints,
            follows,
            metres_per_rad: 1.0,
            ranks: None,
        };
        // Last, since it evaluates the Jacobian of the finished arm.
        arm.metres_per_rad = arm.typical_metres_per_rad();
        Ok(arm)
    }

    /// The independent joints, base to tip: what a configuration of the arm holds.
    pub fn joints(&self) -> &[ArmJoint] {
        &self.joints
    }

    /// Whether the arm has few enough joints for a search over its whole joint range.
    ///
    /// # Errors
    /// [`KinematicsError::SearchedJoints`] if it has more.
    pub fn check_search(&self) -> Result<(), KinematicsError> {
        match self.joints.len() {
            0..=MOST_SEARCHED_JOINTS => Ok(()),
            found => Err(KinematicsError::SearchedJoints { found, most: MOST_SEARCHED_JOINTS }),
        }
    }

    /// Typical distance, m, that the tool moves when a joint turns by one radian: the length that makes metres and radians
    /// comparable for this arm. If the tool lies on all turning axes, as on a spindle, the distance that prismatic joints move
    /// it; 1 if no joint turns.
    pub fn metres_per_rad(&self) -> f64 {
        self.metres_per_rad
    }

    /// The configuration with every joint in the middle of its sampled range.
    pub fn middle(&self) -> ArmQ {
        let middle = |joint: &ArmJoint| f64::midpoint(joint.sampled_range().0, joint.sampled_range().1);
        self.joints.iter().map(middle).collect()
    }

    /// The arm's part of a configuration vector of the robot.
    pub fn from_robot(&self, q_robot: &RobotQ) -> ArmQ {
        self.joints.iter().map(|joint| q_robot[joint.coordinate]).collect()
    }

    /// Writes a configuration of the arm into one of the robot; mimic joints are left to
    /// [`Robot::apply_mimic`].
    pub fn write_to_robot(&self, q: &ArmQ, q_robot: &mut RobotQ) {
        for (joint, &q) in self.joints.iter().zip(q) {
            q_robot[joint.coordinate] = q;
        }
    }

    /// Pose of the tool centre point in the base.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration of the arm.
    pub fn base_from_tcp(&mut self, q: &ArmQ) -> Result<Pose, KinematicsError> {
        self.place(q)?;
        Ok(self.chain.base_from_tip(&self.positions)? * self.tip_from_tcp)
    }

    /// Pose of the tool centre point and its geometric Jacobian: columns in the axes of the base,
    /// the linear part the velocity of the tool centre point.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `q` | number of joints | rad, m | base to tip |
    /// | result | SE(3), and a twist for each joint | m | base |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` is no configuration of the arm.
    pub fn pose_and_jacobian(&mut self, q: &ArmQ) -> Result<(Pose, &[Twist]), KinematicsError> {
        self.place(q)?;
        let kind = JacobianKind::Geometric;
        let base_from_tip = self.chain.pose_and_jacobian_into(&self.positions, kind, &mut self.of_chain)?;
        // The chain gives columns for the tip; the velocity of the tool centre point is v + w x r with r from tip to tool.
        let tcp_from_tip_in_base = base_from_tip.rotation * self.tip_from_tcp.translation;
        // Several joints of the chain may follow one independent joint: by the chain rule their columns add up, each times its
        // multiplier.
        self.columns.fill(Twist::zero());
        for (of_chain, follows) in self.of_chain.iter().zip(&self.follows) {
            let Twist { angular, linear } = *of_chain;
            let column = &mut self.columns[follows.independent];
            column.angular += angular * follows.multiplier;
            column.linear += (linear + angular.cross(&tcp_from_tip_in_base)) * follows.multiplier;
        }
        Ok((base_from_tip * self.tip_from_tcp, &self.columns))
    }

    /// Draws a configuration within the limits.
    pub(crate) fn draw(&self, random: &mut Uniform, q: &mut ArmQ) {
        for (q, joint) in q.iter_mut().zip(&self.joints) {
            let (lower, upper) = joint.sampled_range();
            *q = random.between(lower, upper);
        }
    }

    /// Fixed configurations, spread over the ranges.
    pub(super) fn spread(&self, count: u32) -> Vec<ArmQ> {
        let ranges: Vec<(f64, f64)> = self.joints.iter().map(ArmJoint::sampled_range).collect();
        spread(&ranges, count)
    }

    /// Writes the positions of all joints of the chain, mimic joints included, to `positions`.
    fn place(&mut self, q: &ArmQ) -> Result<(), KinematicsError> {
        KinematicsError::check_joints(self.joints.len(), q)?;
        for (position, follows) in self.positions.iter_mut().zip(&self.follows) {
            *position = follows.multiplier * q[follows.independent] + follows.offset;
        }
        Ok(())
    }

    /// Root mean square over turning joints and a few fixed configurations.
    fn typical_metres_per_rad(&mut self) -> f64 {
        /// Number of configurations: enough for a length that is only a scale.
        const CONFIGURATIONS: u32 = 16;
        /// Shorter lengths count as zero, m. Kind: rounding of sums of some metres.
        const ZERO_M: f64 = 1e-12;
        /// A tool nearer to every turning axis than this share of its own travel is moved by prismatic joints alone.
        const ON_AXIS: f64 = 1e-3;
        let (mut sum, mut turning) = (0.0, 0.0);
        let (mut first, mut travel_m) = (None, 0.0_f64);
        for q in self.spread(CONFIGURATIONS) {
            let (pose, columns) = self.pose_and_jacobian(&q).expect("q is a configuration of this arm");
            let position = pose.translation;
            travel_m = travel_m.max((position - *first.get_or_insert(position)).norm());
            for column in columns {
                let rate = column.angular.norm();
                if rate > 0.0 {
                    sum += (column.linear.norm() / rate).powi(2);
                    turning += 1.0;
                }
            }
        }
        // Root mean square of |v| / |w|, the distance of the tool from each turning axis. Without a turning joint it is 0.
        let by_turning_m = if turning > 0.0 { f64::sqrt(sum / turning) } else { 0.0 };
        match by_turning_m.max(ON_AXIS * travel_m) {
            // 1, so that a unit remains to divide by.
            length_m if turning == 0.0 || length_m < ZERO_M => 1.0,
            _ if by_turning_m < ON_AXIS * travel_m => travel_m,
            _ => by_turning_m,
        }
    }
}

/// Adds a joint of the chain, and the independent joint that it follows unless that is known already.
fn follow(robot: &Robot, index: JointIndex, joints: &mut Vec<ArmJoint>, follows: &mut Vec<Follows>) {
    let joint = robot.joint(index);
    let alone = Mimic { master: index, multiplier: 1.0, offset: 0.0 };
    let Mimic { master, multiplier, offset } = joint.mimic.unwrap_or(alone);
    let independent = joints.iter().position(|known| known.joint == master).unwrap_or_else(|| {
        let (lower, upper) =
            robot.joint(master).position_range().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        joints.push(ArmJoint {
            joint: master,
            coordinate: robot.coordinate(master).expect("a mimicked joint moves"),
            turns: robot.joint(master).kind.is_angular(),
            lower,
            upper,
            wraps: robot.joint(master).kind.is_angular(),
        });
        joints.len() - 1
    });
    follows.push(Follows { independent, multiplier, offset });
    // A full turn of the master turns this joint by `multiplier` turns, which is the same pose only for a whole number.
    joints[independent].wraps &= multiplier.fract().abs() < f64::EPSILON;
    if let (Some((lower, upper)), true) = (joint.position_range(), joint.mimic.is_some() && multiplier != 0.0)
    {
        // The limits of a mimic joint bind its master: q = multiplier q_master + offset solved for q_master; a negative
        // multiplier exchanges the two ends.
        let ends = [(lower - offset) / multiplier, (upper - offset) / multiplier];
        let bound = &mut joints[independent];
        let (lower, upper) = (bound.lower.max(ends[0].min(ends[1])), bound.upper.min(ends[0].max(ends[1])));
        // Ranges that exclude each other are a fault of the description; then the master's own range is kept.
        if lower <= upper {
            (bound.lower, bound.upper) = (lower, upper);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::support;

    fn turning(lower: f64, upper: f64) -> ArmJoint {
        let carried = support::Carried::fixed("tip", "base", nalgebra::Isometry3::identity());
        let index = support::robot(vec![carried]).find_joint("tip").unwrap();
        ArmJoint { joint: index, coordinate: 0, turns: true, lower, upper, wraps: true }
    }

    fn sliding(lower: f64, upper: f64) -> ArmJoint {
        ArmJoint { turns: false, wraps: false, ..turning(lower, upper) }
    }

    #[track_caller]
    fn assert_inside(joint: &ArmJoint, q: f64, expected: f64) {
        assert!((joint.inside(q) - expected).abs() < 1e-12, "{} for {q}", joint.inside(q));
    }

    #[test]
    fn a_turn_further_or_the_limit() {
        let (wide, narrow, slide) = (turning(-TAU, TAU), turning(-1.0, 1.0), sliding(0.0, 0.5));
        assert_inside(&wide, TAU + 0.5, 0.5);
        assert_inside(&wide, -TAU - 0.5, -0.5);
        assert_inside(&narrow, 1.5, 1.0);
        assert_inside(&narrow, TAU + 0.25, 0.25);
        assert_inside(&slide, -0.1, 0.0);
        assert_inside(&slide, 0.2, 0.2);
        assert_inside(&turning(f64::NEG_INFINITY, f64::INFINITY), 100.0, 100.0);
    }

    #[test]
    fn the_nearest_turn_stays_inside() {
        let wide = turning(-TAU, TAU);
        assert!((wide.nearest_turn(0.5, 6.0) - (0.5 + TAU).min(0.5)).abs() < 1e-12);
        assert!((wide.nearest_turn(-0.5, 6.0) - (TAU - 0.5)).abs() < 1e-12);
        assert!((sliding(0.0, 0.5).nearest_turn(0.1, 9.0) - 0.1).abs() < f64::EPSILON);
    }

    #[test]
    fn without_a_moving_joint_there_is_no_arm() {
        let robot =
            support::robot(vec![support::Carried::fixed("tip", "base", nalgebra::Isometry3::identity())]);
        let tip = robot.find_link("tip").unwrap();
        let arm = Arm::new(&robot, robot.root(), tip, Pose::identity());
        assert_eq!(arm.unwrap_err(), KinematicsError::NoJoint);
    }
}
