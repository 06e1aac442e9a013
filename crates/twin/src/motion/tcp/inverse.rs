//! Joint positions along a path of the tool: inverse kinematics at knots, each solved from the one before, and a spline
//! through them that is held against the path between the knots.

use congruent_description::{ArmQ, RobotDescription, RobotQ, display::length_and_angle};
use congruent_kinematics::{
    Arm, IkMethod, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, PoseError, TargetPart,
};
use nalgebra::{Isometry3, Vector3};

use super::geometry::TcpPath;
use crate::motion::joints::{JointSpline, SplineEnds, SplineValues};

/// Distance of knots at first; halved until the path is kept between them.
const KNOT_M: f64 = 2e-3;
/// Likewise, of the turn.
const KNOT_RAD: f64 = 5e-3;
/// At least so many intervals between two stops, and at most so many times the first number of intervals.
const LEAST_INTERVALS: f64 = 32.0;
const MOST_HALVINGS: u32 = 4;
/// Longest path, in intervals at first.
const MOST_INTERVALS: f64 = 40_000.0;
/// How far the tool may be from the path, between knots too.
const PATH_M: f64 = 1e-6;
/// Likewise, its orientation.
const PATH_RAD: f64 = 1e-6;
/// A joint that turns further between two knots, rad, or slides, m, has passed a singularity or changed to another
/// solution.
const BRANCH: f64 = 0.2;

/// Why there are no joint positions along a path.
#[derive(Debug)]
pub(super) enum Stop {
    /// The tool cannot be brought there within the joint limits.
    OutOfReach {
        at_m: f64,
        left: String,
        limits_held: Vec<String>,
        /// By how much the orientation is off if the position alone is led there, rad, and about which axis of the world.
        off: Option<(f64, Vector3<f64>)>,
    },
    /// The joints would have to jump.
    Singular { at_m: f64, joint: String },
    /// The model refuses.
    Model(KinematicsError),
}

impl From<KinematicsError> for Stop {
    fn from(error: KinematicsError) -> Self {
        Self::Model(error)
    }
}

/// Joint positions as a spline over the share of a path in the world.
pub(super) fn along(
    path: &TcpPath,
    description: &RobotDescription,
    (base_from_world, from): (&Isometry3<f64>, &RobotQ),
    part: TargetPart,
) -> Result<JointSpline, Stop> {
    let mut follower = Follower {
        part,
        solver: IkSolver::new(Arm::of(description)?),
        arm: Arm::of(description)?,
        description,
        path,
        base_from_world: *base_from_world,
    };
    let finest = (MOST_INTERVALS / follower.intervals(0, path.ends_m().len())).max(1.0);
    for halvings in 0..=MOST_HALVINGS {
        let spline = follower.spline(f64::from(2_u32.pow(halvings)).min(finest), from)?;
        match follower.furthest(&spline)? {
            None => return Ok(spline),
            Some((at_m, joint)) if halvings == MOST_HALVINGS => return Err(Stop::Singular { at_m, joint }),
            Some(_) => {}
        }
    }
    unreachable!("the last round returns")
}

struct Follower<'a> {
    solver: IkSolver,
    arm: Arm,
    description: &'a RobotDescription,
    path: &'a TcpPath,
    base_from_world: Isometry3<f64>,
    part: TargetPart,
}

impl Follower<'_> {
    fn target(&self, share: f64) -> IkTarget {
        let world_from_tcp = self.path.at(share * self.path.length_m());
        let base_from_tcp = Pose::from(self.base_from_world * world_from_tcp);
        IkTarget { base_from_tcp, part: self.part }
    }

    /// What the orientation lacks at a share of the path if the arm can bring the position there.
    fn orientation_off(
        &mut self,
        share: f64,
        (before, options): (&ArmQ, &IkOptions),
    ) -> Result<Option<(f64, Vector3<f64>)>, KinematicsError> {
        let target = IkTarget { part: TargetPart::Position, ..self.target(share) };
        let found = self.solver.solve(&target, before, options, || true)?;
        if self.part == TargetPart::Position || found.residual_position_m > PATH_M {
            return Ok(None);
        }
        let q = found.q.clone();
        let reached =
            self.base_from_world.rotation.inverse() * self.arm.base_from_tcp(&q)?.to_isometry().rotation;
        let wanted = self.path.at(share * self.path.length_m()).rotation;
        let off = reached.rotation_to(&wanted);
        Ok(off.axis().map(|axis| (off.angle(), axis.into_inner())))
    }

    fn name(&self, arm_joint: usize) -> String {
        let robot = &self.description.robot;
        robot.joint(self.arm.joints()[arm_joint].joint).name.clone()
    }

    /// Intervals over some segments, at first.
    fn intervals(&self, first: usize, end: usize) -> f64 {
        let start_m = if first == 0 { 0.0 } else { self.path.ends_m()[first - 1] };
        let length_m = self.path.ends_m()[end - 1] - start_m;
        let turn_rad: f64 = self.path.turns_rad().skip(first).take(end - first).sum();
        (length_m / KNOT_M).max(turn_rad / KNOT_RAD).ceil().max(LEAST_INTERVALS)
    }

    /// The spline through knots so many times denser than at first. Where the tool stops the path has a corner, and one
    /// spline ends and another begins.
    fn spline(&mut self, denser: f64, from: &RobotQ) -> Result<JointSpline, Stop> {
        let (mut parts, mut start, mut first) = (Vec::new(), (0.0, from.clone()), 0);
        for end in 1..=self.path.ends_m().len() {
            if end < self.path.ends_m().len() && !self.path.stops_after(end - 1) {
                continue;
            }
            let intervals = (self.intervals(first, end) * denser).ceil();
            let until = self.path.ends_m()[end - 1] / self.path.length_m();
            let (knots, points) = self.solve((start.0, until), intervals, &start.1)?;
            start = (until, points[points.len() - 1].clone());
            parts.push(JointSpline::new(&knots, &points, SplineEnds::Parabola));
            first = end;
        }
        Ok(JointSpline::joined(parts))
    }

    /// Configurations at equal distances from one share of the path to another.
    fn solve(
        &mut self,
        (start, until): (f64, f64),
        intervals: f64,
        from: &RobotQ,
    ) -> Result<(Vec<f64>, Vec<RobotQ>), Stop> {
        // From one knot to the next a few steps converge; a restart would find another solution.
        let options = IkOptions {
            method: IkMethod::LevenbergMarquardt,
            tolerance_m: 1e-11,
            tolerance_rad: 1e-11,
            max_iterations: 40,
            ..IkOptions::default()
        };
        let mut before: ArmQ = self.arm.from_robot(from);
        let (mut knots, mut points) = (vec![start], vec![from.clone()]);
        let mut knot = 1.0;
        while knot <= intervals {
            let share = if knot < intervals { start + (until - start) * knot / intervals } else { until };
            let at_m = share * self.path.length_m();
            let target = self.target(share);
            let found = self.solver.solve(&target, &before, &options, || true)?;
            if !found.converged
                && (found.residual_position_m > PATH_M
                    || (self.part == TargetPart::Pose && found.residual_orientation_rad > PATH_RAD))
            {
                let left = length_and_angle(found.residual_position_m, found.residual_orientation_rad);
                let held = found.limits_held.to_vec();
                let limits_held = held.into_iter().map(|joint| self.name(joint)).collect();
                let off = self.orientation_off(share, (&before, &options))?;
                return Err(Stop::OutOfReach { at_m, left, limits_held, off });
            }
            let now = found.q.clone();
            let jump = now.iter().zip(&before).position(|(now, before)| (now - before).abs() > BRANCH);
            if let Some(joint) = jump {
                return Err(Stop::Singular { at_m, joint: self.name(joint) });
            }
            let mut q = from.clone();
            self.arm.write_to_robot(&now, &mut q);
            self.description.robot.apply_mimic(&mut q);
            knots.push(share);
            points.push(q);
            before = now;
            knot += 1.0;
        }
        Ok((knots, points))
    }

    /// Where between knots the tool is furthest from the path, if it is too far, with the joint that moves most there.
    fn furthest(&mut self, spline: &JointSpline) -> Result<Option<(f64, String)>, Stop> {
        let dof = self.description.robot.dof();
        let mut q = RobotQ::zeros(dof);
        let (mut first, mut second) = (vec![0.0; dof], vec![0.0; dof]);
        let mut furthest: Option<(f64, f64, usize)> = None;
        for pair in spline.knots().windows(2) {
            let share = f64::midpoint(pair[0], pair[1]);
            spline.at(share, SplineValues { q: &mut q, first: &mut first, second: &mut second });
            let arm_q = self.arm.from_robot(&q);
            let found = self.arm.base_from_tcp(&arm_q)?;
            let error = PoseError::to_isometry(&self.target(share).base_from_tcp, &found.to_isometry());
            let turned = match self.part {
                TargetPart::Pose => error.orientation_rad / PATH_RAD,
                TargetPart::Position => 0.0,
            };
            let times = (error.position_m / PATH_M).max(turned);
            if times > furthest.map_or(1.0, |(worst, ..)| worst) {
                let speed = |joint: &usize| first[self.arm.joints()[*joint].coordinate].abs();
                let fastest = (0..self.arm.joints().len()).max_by(|a, b| speed(a).total_cmp(&speed(b)));
                furthest = Some((times, share * self.path.length_m(), fastest.unwrap_or(0)));
            }
        }
        Ok(furthest.map(|(_, at_m, joint)| (at_m, self.name(joint))))
    }
}
