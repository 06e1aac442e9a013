//! Joint positions along a path of the tool: inverse kinematics at knots, each solved from the one before, and a spline
//! through them that is compared with the path between the knots.

use congruent_description::{ArmQ, RobotDescription, RobotQ};
use congruent_input::display::length_and_angle;
use congruent_kinematics::{
    Arm, IkMethod, IkOptions, IkSolver, IkTarget, KinematicsError, Pose, PoseError, TargetPart,
};
use nalgebra::{Isometry3, Vector3};

use super::geometry::TcpPath;
use crate::{JointSpline, SplineEnds, spline::SplineValues};

/// Initial distance of knots; halved until the spline keeps the path between them.
const KNOT_M: f64 = 2e-3;
/// Initial rotation of the tool from knot to knot.
const KNOT_RAD: f64 = 5e-3;
/// Least number of intervals between two stops.
const LEAST_INTERVALS: f64 = 32.0;
/// How often the distance of the knots is halved, at most.
const MOST_HALVINGS: u32 = 4;
/// Number of intervals above which a path is not refined: it bounds time and memory of planning.
const MOST_INTERVALS: f64 = 40_000.0;
/// Largest distance of the tool from the path, at knots and between them.
const PATH_M: f64 = 1e-6;
/// Largest orientation error of the tool, at knots and between them.
const PATH_RAD: f64 = 1e-6;
/// A joint that moves further between two knots, rad or m, has passed a singularity or changed to another solution of the
/// inverse kinematics.
const BRANCH: f64 = 0.2;

/// Why there are no joint positions along a path.
#[derive(Debug)]
pub(super) enum PathFailure {
    /// The tool cannot reach the path within the joint limits.
    OutOfReach {
        at_m: f64,
        smallest_error: String,
        limits_held: Vec<String>,
        /// Orientation error if the position alone is controlled: angle, rad, and axis in the world.
        off: Option<(f64, Vector3<f64>)>,
    },
    /// A joint would have to jump.
    Singular { at_m: f64, joint: String },
    /// The kinematic model of the arm cannot be built or evaluated.
    Model(KinematicsError),
}

impl From<KinematicsError> for PathFailure {
    fn from(error: KinematicsError) -> Self {
        Self::Model(error)
    }
}

/// Joint positions as a spline over the share of a path in the world.
pub(super) fn along(
    path: &TcpPath,
    description: &RobotDescription,
    base_from_world: &Isometry3<f64>,
    from: &RobotQ,
    part: TargetPart,
) -> Result<JointSpline, PathFailure> {
    let mut path_solver = PathSolver {
        part,
        solver: IkSolver::new(Arm::from_description(description)?),
        arm: Arm::from_description(description)?,
        description,
        path,
        base_from_world: *base_from_world,
    };
    let finest = (MOST_INTERVALS / path_solver.intervals(0, path.ends_m().len())).max(1.0);
    // The error of a cubic spline falls with the fourth power of the distance: each halving gains a factor of 16. A path that
    // is still not kept after the last one passes a singularity, near which joints move ever faster.
    for halvings in 0..=MOST_HALVINGS {
        let spline = path_solver.spline(f64::from(2_u32.pow(halvings)).min(finest), from)?;
        match path_solver.furthest(&spline)? {
            None => return Ok(spline),
            Some((at_m, joint)) if halvings == MOST_HALVINGS => {
                return Err(PathFailure::Singular { at_m, joint });
            }
            Some(_) => {}
        }
    }
    unreachable!("the last round returns")
}

struct PathSolver<'a> {
    solver: IkSolver,
    arm: Arm,
    description: &'a RobotDescription,
    path: &'a TcpPath,
    base_from_world: Isometry3<f64>,
    part: TargetPart,
}

impl PathSolver<'_> {
    fn target(&self, share: f64) -> IkTarget {
        let world_from_tcp = self.path.at(share * self.path.length_m());
        let base_from_tcp = Pose::from(self.base_from_world * world_from_tcp);
        IkTarget { base_from_tcp, part: self.part }
    }

    /// The orientation error at a share of the path if the position alone is controlled; `None` if that is out of reach too.
    fn orientation_off(
        &mut self,
        share: f64,
        before: &ArmQ,
        options: &IkOptions,
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

    /// Initial number of intervals over some segments: enough for the translation and for the rotation.
    fn intervals(&self, first: usize, end: usize) -> f64 {
        let start_m = if first == 0 { 0.0 } else { self.path.ends_m()[first - 1] };
        let length_m = self.path.ends_m()[end - 1] - start_m;
        let turn_rad: f64 = self.path.turns_rad().skip(first).take(end - first).sum();
        (length_m / KNOT_M).max(turn_rad / KNOT_RAD).ceil().max(LEAST_INTERVALS)
    }

    /// The spline through knots that are `denser` times as many as at first. Where the tool stops the path may have a corner,
    /// which a single spline would round off: there one spline ends and another begins.
    fn spline(&mut self, denser: f64, from: &RobotQ) -> Result<JointSpline, PathFailure> {
        let (mut parts, mut start, mut first) = (Vec::new(), (0.0, from.clone()), 0);
        for end in 1..=self.path.ends_m().len() {
            if end < self.path.ends_m().len() && !self.path.stops_after(end - 1) {
                continue;
            }
            let intervals = (self.intervals(first, end) * denser).ceil();
            let until = self.path.ends_m()[end - 1] / self.path.length_m();
            let (knots, points) = self.solve(start.0, until, intervals, &start.1)?;
            start = (until, points[points.len() - 1].clone());
            parts.push(JointSpline::new(&knots, &points, SplineEnds::Parabola));
            first = end;
        }
        Ok(JointSpline::joined(parts))
    }

    /// Configurations at equal distances from one share of the path to another.
    fn solve(
        &mut self,
        start: f64,
        until: f64,
        intervals: f64,
        from: &RobotQ,
    ) -> Result<(Vec<f64>, Vec<RobotQ>), PathFailure> {
        // From one knot to the next a few steps converge; a restart could find another solution and make the joints jump.
        // 1e-11, far below the path's tolerance: the second derivatives of a spline amplify errors of knots by 1/h^2.
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
            // The last knot is exactly the end: the next spline begins there.
            let share = if knot < intervals { start + (until - start) * knot / intervals } else { until };
            let at_m = share * self.path.length_m();
            let target = self.target(share);
            let found = self.solver.solve(&target, &before, &options, || true)?;
            // Not converged to 1e-11 but within the path's tolerance, as near a singularity, is good enough.
            if !found.converged
                && (found.residual_position_m > PATH_M
                    || (self.part == TargetPart::Pose && found.residual_orientation_rad > PATH_RAD))
            {
                let smallest_error =
                    length_and_angle(found.residual_position_m, found.residual_orientation_rad);
                let held = found.limits_held.to_vec();
                let limits_held = held.into_iter().map(|joint| self.name(joint)).collect();
                let off = self.orientation_off(share, &before, &options)?;
                return Err(PathFailure::OutOfReach { at_m, smallest_error, limits_held, off });
            }
            let now = found.q.clone();
            // Before the knot is taken: a spline through a jump would keep the path at its knots and leave it between them.
            let jump = now.iter().zip(&before).position(|(now, before)| (now - before).abs() > BRANCH);
            if let Some(joint) = jump {
                return Err(PathFailure::Singular { at_m, joint: self.name(joint) });
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

    /// The place between knots with the largest error of the tool beyond the tolerance, m along the path, with the joint that
    /// is fastest there.
    fn furthest(&mut self, spline: &JointSpline) -> Result<Option<(f64, String)>, PathFailure> {
        let dof = self.description.robot.dof();
        let mut q = RobotQ::zeros(dof);
        let (mut first, mut second) = (vec![0.0; dof], vec![0.0; dof]);
        let mut furthest: Option<(f64, f64, usize)> = None;
        for pair in spline.knots().windows(2) {
            // Halfway between knots, where the error of an interpolating cubic is largest.
            let share = f64::midpoint(pair[0], pair[1]);
            spline.at(share, SplineValues { q: &mut q, first: &mut first, second: &mut second });
            let arm_q = self.arm.from_robot(&q);
            let found = self.arm.base_from_tcp(&arm_q)?;
            let error = PoseError::to_isometry(&self.target(share).base_from_tcp, &found.to_isometry());
            let turned = match self.part {
                TargetPart::Pose => error.orientation_rad / PATH_RAD,
                TargetPart::Position => 0.0,
            };
            // In multiples of the tolerances, so that metres and radians compare.
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
