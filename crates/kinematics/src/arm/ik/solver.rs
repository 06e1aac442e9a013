//! The iteration of inverse kinematics: attempts, limits, restarts, and the result.

use congruent_description::ArmQ;
use nalgebra::Vector6;

use super::{
    options::{DifferentialMethod, IkMethod, IkOptions},
    residual::{IkResidual, IkTarget, TaskFrame},
    result::{IkChange, IkResult},
    step::{self, IkTask},
};
use crate::{
    arm::model::{Arm, ArmJoint},
    error::KinematicsError,
    uniform::Uniform,
};

/// An attempt goes on as long as its cost falls to this share within [`PATIENCE`] steps.
const PROGRESS: f64 = 0.5;
/// Steps without progress after which an attempt is given up.
const PATIENCE: usize = 7;
/// A method without restarts stops if no joint moves further than this. Kind: rounding.
const SMALLEST_CHANGE: f64 = 1e-15;

/// Solves one target after another for an arm, without allocation.
///
/// # Examples
/// See [`IkSolver::solve`].
#[derive(Debug, Clone)]
pub struct IkSolver {
    arm: Arm,
    q: ArmQ,
    best: ArmQ,
    change: Vec<f64>,
    columns: Vec<Vector6<f64>>,
    kept_at_limit: Vec<bool>,
    limits_held: Vec<usize>,
}

impl IkSolver {
    /// A solver for an arm, with all buffers allocated.
    pub fn new(arm: Arm) -> Self {
        let n = arm.joints().len();
        Self {
            q: ArmQ::zeros(n),
            best: ArmQ::zeros(n),
            change: vec![0.0; n],
            columns: vec![Vector6::zeros(); n],
            kept_at_limit: vec![false; n],
            limits_held: Vec::with_capacity(n),
            arm,
        }
    }

    /// The arm that is solved for.
    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// A configuration that brings the tool to the target, or the best that was found.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `target` | SE(3) | m | `base_from_tcp` |
    /// | `start` | number of joints | rad, m | base to tip |
    ///
    /// The number of steps is bounded by the options; `keep_going` is called before each and may end
    /// the search earlier, for example when a time limit of the caller is over.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `start` is no configuration of the arm.
    /// # Examples
    /// An arm of two links of 0.6 m and 0.4 m reaches (0.6, 0.4), and gives the residual of (2, 0):
    /// ```
    /// # use congruent_description::{JointKind, JointParts, Link, Robot};
    /// # use nalgebra::{Isometry3, Matrix3, Vector3};
    /// use congruent_description::ArmQ;
    /// use congruent_kinematics::{Arm, IkOptions, IkSolver, IkTarget, Pose, TargetPart};
    /// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// # let at = |x: f64| Isometry3::translation(x, 0., 0.);
    /// # let robot = Robot::new("2r", vec![link("base"), link("upper"), link("lower"), link("tip")], vec![
    /// #     JointParts::new("shoulder", JointKind::Continuous, "base", "upper", at(0.)),
    /// #     JointParts::new("elbow", JointKind::Continuous, "upper", "lower", at(0.6)),
    /// #     JointParts::new("flange", JointKind::Fixed, "lower", "tip", at(0.4))]).unwrap();
    /// let tip = robot.find_link("tip").unwrap();
    /// let mut solver = IkSolver::new(Arm::new(&robot, robot.root(), tip, Pose::identity())?);
    /// let to = |x, y| IkTarget {
    ///     base_from_tcp: Pose::from_parts(Matrix3::identity(), Vector3::new(x, y, 0.)),
    ///     part: TargetPart::Position,
    /// };
    /// let options = IkOptions::default();
    /// let start = ArmQ::from([0.1, 1.0]);
    /// let reached = solver.solve(&to(0.6, 0.4), &start, &options, || true)?;
    /// assert!(reached.converged && (reached.q[1] - std::f64::consts::FRAC_PI_2).abs() < 1e-8);
    /// let beyond = solver.solve(&to(2.0, 0.0), &start, &options, || true)?;
    /// assert!(!beyond.converged && (beyond.residual_position_m - 1.0).abs() < 1e-6);
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn solve(
        &mut self,
        target: &IkTarget,
        start: &ArmQ,
        options: &IkOptions,
        keep_going: impl FnMut() -> bool,
    ) -> Result<IkResult<'_>, KinematicsError> {
        KinematicsError::check_joints(self.q.len(), start)?;
        // The search stays within the limits from its first step on, so any of its configurations may be returned.
        for ((q, joint), &start) in self.q.iter_mut().zip(self.arm.joints()).zip(start) {
            *q = joint.inside(start);
        }
        let (best, iterations) = self.search(target, options, keep_going)?;
        // The steps may have gone round by whole turns; the caller gets the equal configuration nearest to its own.
        self.turn_towards(start);
        self.limits_held.clear();
        let at_limit = |(joint, &q): (&ArmJoint, &f64)| q <= joint.lower || q >= joint.upper;
        let kept_at_limit = self.arm.joints().iter().zip(&self.best).enumerate();
        self.limits_held.extend(kept_at_limit.filter(|(_, each)| at_limit(*each)).map(|(index, _)| index));
        Ok(IkResult {
            q: &self.best,
            converged: best.within(options),
            residual_position_m: best.position_m,
            residual_orientation_rad: best.orientation_rad,
            iterations,
            limits_held: &self.limits_held,
        })
    }

    /// One step of differential inverse kinematics, for a loop that is closed from outside: the change
    /// of the joints that would close the error from `q` to the target if the arm were linear.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `target` | SE(3) | m | `base_from_tcp` |
    /// | `q` | number of joints | rad, m | base to tip |
    /// | `commanded` | number of joints | rad, m | base to tip |
    /// | change | number of joints | rad, m | base to tip |
    ///
    /// Error and Jacobian are evaluated at `q`, the measured configuration; the error is `p_d - p` and, as axis and
    /// angle, `R_d R^T`. `commanded` is the last setpoint: a joint whose setpoint is at its limit is kept there. Times a gain,
    /// the change is a joint velocity. The result is not limited.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` or `commanded` is no configuration of the arm.
    /// # Examples
    /// A slide 0.3 m before its target has 0.3 m to go, until its setpoint is at the limit:
    /// ```
    /// # use congruent_description::{JointKind, JointLimit, JointParts, Link, Robot};
    /// # use nalgebra::{Isometry3, Matrix3, Vector3};
    /// use congruent_description::ArmQ;
    /// use congruent_kinematics::{Arm, DifferentialMethod, IkSolver, IkTarget, Pose, TargetPart};
    /// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// # let mut parts = JointParts::new("slide", JointKind::Prismatic, "base", "tip", Isometry3::identity());
    /// # parts.joint.axis_in_joint = Vector3::x_axis();
    /// # parts.joint.limit = Some(JointLimit { lower: 0., upper: 0.5, ..JointLimit::default() });
    /// # let robot = Robot::new("1p", vec![link("base"), link("tip")], vec![parts]).unwrap();
    /// let tip = robot.find_link("tip").unwrap();
    /// let mut solver = IkSolver::new(Arm::new(&robot, robot.root(), tip, Pose::identity())?); // goes from 0 to 0.5 m
    /// let target = IkTarget {
    ///     base_from_tcp: Pose::from_parts(Matrix3::identity(), Vector3::new(0.7, 0., 0.)),
    ///     part: TargetPart::Position,
    /// };
    /// let (inside, at_limit) = (ArmQ::from([0.4]), ArmQ::from([0.5]));
    /// for method in [DifferentialMethod::PseudoInverse, DifferentialMethod::Transpose] {
    ///     let step = solver.change_towards(&target, &inside, &inside, method)?;
    ///     assert!((step.change[0] - 0.3).abs() < 1e-15 && step.limits_held.is_empty());
    ///     let step = solver.change_towards(&target, &inside, &at_limit, method)?;
    ///     assert_eq!((step.change, step.limits_held), ([0.0].as_slice(), [0].as_slice()));
    /// }
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn change_towards(
        &mut self,
        target: &IkTarget,
        q: &ArmQ,
        commanded: &ArmQ,
        method: DifferentialMethod,
    ) -> Result<IkChange<'_>, KinematicsError> {
        KinematicsError::check_joints(self.q.len(), q)?;
        KinematicsError::check_joints(self.q.len(), commanded)?;
        self.q.copy_from_slice(q);
        let (frame, rule): (_, fn(&IkTask<'_>, &mut [f64])) = match method {
            DifferentialMethod::PseudoInverse => (IkMethod::PseudoInverse, step::damped_pseudo_inverse),
            DifferentialMethod::Transpose => (IkMethod::Transpose, step::transposed),
        };
        let frame = TaskFrame::for_method(frame, target.part, self.arm.metres_per_rad());
        let residual = self.evaluate(target, &frame)?;
        // Limits are those of the setpoint, not of the measured position, which may be short of the limit by a tracking error.
        self.q.copy_from_slice(commanded);
        self.mark_joints_at_limits(&residual);
        self.apply_method(rule, &residual);
        self.limits_held.clear();
        let kept_at_limit =
            self.kept_at_limit.iter().enumerate().filter(|(_, kept_at_limit)| **kept_at_limit);
        self.limits_held.extend(kept_at_limit.map(|(index, _)| index));
        Ok(IkChange {
            change: &self.change,
            residual_position_m: residual.position_m,
            residual_orientation_rad: residual.orientation_rad,
            limits_held: &self.limits_held,
        })
    }

    /// The solution of the last search.
    pub(super) fn solution(&self) -> &ArmQ {
        &self.best
    }

    /// Moves the solution by whole turns as near to `start` as the limits allow. Returns the sum of squares of the
    /// difference of the two, in rad^2.
    pub(super) fn turn_towards(&mut self, start: &ArmQ) -> f64 {
        let rad_per_metre = 1.0 / self.arm.metres_per_rad();
        let mut sum = 0.0;
        for ((q, joint), &start) in self.best.iter_mut().zip(self.arm.joints()).zip(start) {
            *q = joint.nearest_turn(*q, start);
            let unit = if joint.turns { 1.0 } else { rad_per_metre };
            sum += ((*q - start) * unit).powi(2);
        }
        sum
    }

    /// Writes the best configuration to `best`. Returns its residual and the number of steps.
    fn search(
        &mut self,
        target: &IkTarget,
        options: &IkOptions,
        mut keep_going: impl FnMut() -> bool,
    ) -> Result<(IkResidual, usize), KinematicsError> {
        let frame = TaskFrame::for_method(options.method, target.part, self.arm.metres_per_rad());
        let mut residual = self.evaluate(target, &frame)?;
        let mut best = residual;
        self.best.copy_from_slice(&self.q);
        let mut attempt = Attempt::starting_at(residual.cost());
        let mut random = None;
        for iteration in 0..options.max_iterations {
            if best.within(options) || !keep_going() {
                return Ok((best, iteration));
            }
            // A restart costs one evaluation like a step does, so it counts as a step and the bound holds. The generator is made
            // only here: most targets need no restart.
            if options.method == IkMethod::LevenbergMarquardt && attempt.is_stuck() {
                let random = random.get_or_insert_with(|| Uniform::seeded(options.seed));
                self.arm.draw(random, &mut self.q);
                residual = self.evaluate(target, &frame)?;
                attempt = Attempt::starting_at(residual.cost());
            } else {
                let moved = self.step(options.method, &residual);
                // The textbook methods have no restarts: a step of zero, at a limit or a singular configuration, repeats for ever.
                if options.method != IkMethod::LevenbergMarquardt && moved <= SMALLEST_CHANGE {
                    return Ok((best, iteration));
                }
                residual = self.evaluate(target, &frame)?;
                attempt.observe(residual.cost());
            }
            // A pose within tolerance counts even if its cost is higher: cost mixes metres and radians, the tolerances do not.
            if residual.cost() < best.cost() || residual.within(options) {
                best = residual;
                self.best.copy_from_slice(&self.q);
            }
        }
        Ok((best, options.max_iterations))
    }

    /// Computes the residual, and writes the columns of the task at `q`.
    fn evaluate(&mut self, target: &IkTarget, frame: &TaskFrame) -> Result<IkResidual, KinematicsError> {
        let (base_from_tcp, columns) = self.arm.pose_and_jacobian(&self.q)?;
        for (task, column) in self.columns.iter_mut().zip(columns) {
            *task = frame.column(column, &base_from_tcp, target.part);
        }
        Ok(IkResidual::between(target, &base_from_tcp, frame))
    }

    /// Moves `q` by one step, within the limits. Returns the largest change of a joint, rad or m.
    fn step(&mut self, method: IkMethod, residual: &IkResidual) -> f64 {
        self.mark_joints_at_limits(residual);
        let rule = match method {
            IkMethod::LevenbergMarquardt => step::damped,
            IkMethod::Newton | IkMethod::PseudoInverse => step::pseudo_inverse,
            IkMethod::Transpose => step::transposed,
        };
        self.apply_method(rule, residual);
        let mut longest: f64 = 0.0;
        for ((q, joint), change) in self.q.iter_mut().zip(self.arm.joints()).zip(&self.change) {
            let before = std::mem::replace(q, joint.inside(*q + change));
            longest = longest.max((*q - before).abs());
        }
        longest
    }

    /// Marks the joints that are at a limit in `q` and that the residual pushes beyond it.
    fn mark_joints_at_limits(&mut self, residual: &IkResidual) {
        for (at, joint) in self.arm.joints().iter().enumerate() {
            // The gradient of the cost by this joint is -J_i . e: its sign says to which side the joint would move. A joint that
            // is kept at its limit must leave the equations, or the step would count on a motion that is cut off.
            let pull = self.columns[at].dot(&residual.task);
            let q = self.q[at];
            self.kept_at_limit[at] = (q <= joint.lower && pull < 0.0) || (q >= joint.upper && pull > 0.0);
        }
    }

    /// Writes the change of the joints that a rule finds to `change`.
    fn apply_method(&mut self, rule: fn(&IkTask<'_>, &mut [f64]), residual: &IkResidual) {
        let task = IkTask {
            columns: &self.columns,
            kept_at_limit: &self.kept_at_limit,
            residual: &residual.task,
            cost: residual.cost(),
        };
        rule(&task, &mut self.change);
    }
}

/// The progress of one attempt.
struct Attempt {
    cost_to_beat: f64,
    steps_without_progress: usize,
}

impl Attempt {
    fn starting_at(cost: f64) -> Self {
        Self { cost_to_beat: PROGRESS * cost, steps_without_progress: 0 }
    }

    fn observe(&mut self, cost: f64) {
        // Compared with the cost at the last progress instead of the last step: a slow descent counts as long as it halves the
        // cost within the patience, and oscillation does not.
        if cost < self.cost_to_beat {
            *self = Self::starting_at(cost);
        } else {
            self.steps_without_progress += 1;
        }
    }

    fn is_stuck(&self) -> bool {
        self.steps_without_progress > PATIENCE
    }
}
