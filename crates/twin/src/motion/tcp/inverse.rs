//! Joint positions along a path of the tool: inverse kinematics at knots, each solved from the one before, and a spline
//! through them that is held against the path between the knots.

use congruent_description::{ArmQ, RobotDescription, RobotQ, display::length_and_angle};
use congruent_kinematics::{
    Arm, IkMethod, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, PoseError, TargetPart,
};
use nalgebra::Isometry3;

use super::geometry::TcpPath;
use crate::motion::joints::{JointSpline, SplineEnds, SplineValues};

/// Distance of knots at first; halved until the path is kept between them.
const KNOT_M: f64 = 2e-3;
/// Likewise, of the turn.
const KNOT_RAD: f64 = 5e-3;
/// At least so many knots, and at most.
const KNOTS: (f64, f64) = (64.0, 40_000.0);
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
    OutOfReach { at_m: f64, left: String, limits_held: Vec<String> },
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
) -> Result<JointSpline, Stop> {
    let mut follower = Follower {
        solver: IkSolver::new(Arm::of(description)?),
        arm: Arm::of(description)?,
        description,
        path,
        base_from_world: *base_from_world,
    };
    let (least, most) = KNOTS;
    let mut intervals = (path.length_m() / KNOT_M).max(path.turn_rad() / KNOT_RAD).ceil().clamp(least, most);
    loop {
        let spline = follower.spline(intervals, from)?;
        match follower.furthest(&spline)? {
            None => return Ok(spline),
            Some(_) if 2.0 * intervals <= most => intervals *= 2.0,
            Some((at_m, joint)) => return Err(Stop::Singular { at_m, joint }),
        }
    }
}

struct Follower<'a> {
    solver: IkSolver,
    arm: Arm,
    description: &'a RobotDescription,
    path: &'a TcpPath,
    base_from_world: Isometry3<f64>,
}

impl Follower<'_> {
    fn target(&self, share: f64) -> IkTarget {
        let world_from_tcp = self.path.at(share * self.path.length_m());
        let base_from_tcp = Pose::from(self.base_from_world * world_from_tcp);
        IkTarget { base_from_tcp, part: TargetPart::Pose }
    }

    fn name(&self, arm_joint: usize) -> String {
        let robot = &self.description.robot;
        robot.joint(self.arm.joints()[arm_joint].joint).name.clone()
    }

    /// The spline through so many knots at equal distances.
    fn spline(&mut self, intervals: f64, from: &RobotQ) -> Result<JointSpline, Stop> {
        // From one knot to the next a few steps converge; a restart would find another solution.
        let options = IkOptions {
            method: IkMethod::LevenbergMarquardt,
            tolerance_m: 1e-11,
            tolerance_rad: 1e-11,
            max_iterations: 40,
            ..IkOptions::default()
        };
        let robot = &self.description.robot;
        let mut before: ArmQ = self.arm.from_robot(from);
        let (mut knots, mut points) = (vec![0.0], vec![from.clone()]);
        let mut knot = 1.0;
        while knot <= intervals {
            let share = knot / intervals;
            let at_m = share * self.path.length_m();
            let target = self.target(share);
            let found = self.solver.solve(&target, &before, &options, || true)?;
            if !found.converged
                && (found.residual_position_m > PATH_M || found.residual_orientation_rad > PATH_RAD)
            {
                let left = length_and_angle(found.residual_position_m, found.residual_orientation_rad);
                let held = found.limits_held.to_vec();
                let limits_held = held.into_iter().map(|joint| self.name(joint)).collect();
                return Err(Stop::OutOfReach { at_m, left, limits_held });
            }
            let now = found.q.clone();
            let jump = now.iter().zip(&before).position(|(now, before)| (now - before).abs() > BRANCH);
            if let Some(joint) = jump {
                return Err(Stop::Singular { at_m, joint: self.name(joint) });
            }
            let mut q = from.clone();
            self.arm.write_to_robot(&now, &mut q);
            robot.apply_mimic(&mut q);
            knots.push(share);
            points.push(q);
            before = now;
            knot += 1.0;
        }
        Ok(JointSpline::new(&knots, &points, SplineEnds::Parabola))
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
            let times = (error.position_m / PATH_M).max(error.orientation_rad / PATH_RAD);
            if times > furthest.map_or(1.0, |(worst, ..)| worst) {
                let speed = |joint: &usize| first[self.arm.joints()[*joint].coordinate].abs();
                let fastest = (0..self.arm.joints().len()).max_by(|a, b| speed(a).total_cmp(&speed(b)));
                furthest = Some((times, share * self.path.length_m(), fastest.unwrap_or(0)));
            }
        }
        Ok(furthest.map(|(_, at_m, joint)| (at_m, self.name(joint))))
    }
}
