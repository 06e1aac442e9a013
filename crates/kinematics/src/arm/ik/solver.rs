//! The loop around the steps: attempts, limits, restarts, and what is reported at the end.

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
const STANDSTILL: f64 = 1e-15;

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
    held: Vec<bool>,
    limits_held: Vec<usize>,
}

impl IkSolver {
    /// Makes room for an arm.
    pub fn new(arm: Arm) -> Self {
        let n = arm.joints().len();
        Self {
            q: ArmQ::zeros(n),
            best: ArmQ::zeros(n),
            change: vec![0.0; n],
            columns: vec![Vector6::zeros(); n],
            held: vec![false; n],
            limits_held: Vec::with_capacity(n),
            arm,
        }
    }

    /// The arm.
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
    /// The number of steps is bounded by the options; `keep_going` is asked before each and may end
    /// the search earlier: a caller with a clock looks at it there.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `start` is no configuration of the arm.
    /// # Examples
    /// An arm of two links of 0.6 m and 0.4 m reaches (0.6, 0.4), and gives the residual of (2, 0):
    /// ```
    /// # use congruent_description::{Joint, JointKind, JointParts, Link, Robot};
    /// # use nalgebra::{Isometry3, Matrix3, Vector3};
    /// use congruent_description::ArmQ;
    /// use congruent_kinematics::{Arm, IkOptions, IkSolver, IkTarget, Pose, TargetPart};
    /// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// # let single = Robot::new("r", vec![link("base")], vec![]).unwrap();
    /// # let parts = |name: &str, kind, parent: &str, child: &str, x: f64| JointParts {
    /// #     joint: Joint {
    /// #         name: name.into(), kind, parent: single.root(), child: single.root(),
    /// #         parent_from_joint: Isometry3::translation(x, 0., 0.), axis_in_joint: Vector3::z_axis(),
    /// #         limit: None, damping: 0., friction: 0., mimic: None,
    /// #     },
    /// #     parent: parent.into(), child: child.into(), mimic: None,
    /// # };
    /// # let robot = Robot::new("2r", vec![link("base"), link("upper"), link("lower"), link("tip")], vec![
    /// #     parts("shoulder", JointKind::Continuous, "base", "upper", 0.),
    /// #     parts("elbow", JointKind::Continuous, "upper", "lower", 0.6),
    /// #     parts("flange", JointKind::Fixed, "lower", "tip", 0.4)]).unwrap();
    /// let ends = (robot.root(), robot.find_link("tip").unwrap());
    /// let mut solver = IkSolver::new(Arm::new(&robot, ends, Pose::identity())?);
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
        for ((q, joint), &start) in self.q.iter_mut().zip(self.arm.joints()).zip(start) {
            *q = joint.inside(start);
        }
        let (best, iterations) = self.search(target, options, keep_going)?;
        self.turn_towards(start);
        self.limits_held.clear();
        let at_limit = |(joint, &q): (&ArmJoint, &f64)| q <= joint.lower || q >= joint.upper;
        let held = self.arm.joints().iter().zip(&self.best).enumerate();
        self.limits_held.extend(held.filter(|(_, each)| at_limit(*each)).map(|(index, _)| index));
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
    /// Error and Jacobian are those at `q`, where the arm is; the error is `p_d - p` and, as axis and
    /// angle, `R_d R^T`. `commanded` is what the arm was told last: a joint that is told to stand at its
    /// limit is held there. Times a gain, the change is a joint velocity. No limit is applied to it.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `q` or `commanded` is no configuration of the arm.
    /// # Examples
    /// A slide that stands 0.3 m before its target has 0.3 m to go, as long as it is told to:
    /// ```
    /// # use congruent_description::{Joint, JointKind, JointLimit, JointParts, Link, Robot};
    /// # use nalgebra::{Isometry3, Matrix3, Vector3};
    /// use congruent_description::ArmQ;
    /// use congruent_kinematics::{Arm, DifferentialMethod, IkSolver, IkTarget, Pose, TargetPart};
    /// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
    /// # let single = Robot::new("r", vec![link("base")], vec![]).unwrap();
    /// # let slide = Joint {
    /// #     name: "slide".into(), kind: JointKind::Prismatic, parent: single.root(), child: single.root(),
    /// #     parent_from_joint: Isometry3::identity(), axis_in_joint: Vector3::x_axis(),
    /// #     limit: Some(JointLimit { lower: 0., upper: 0.5, velocity: None, effort: None }),
    /// #     damping: 0., friction: 0., mimic: None,
    /// # };
    /// # let parts = JointParts { joint: slide, parent: "base".into(), child: "tip".into(), mimic: None };
    /// # let robot = Robot::new("1p", vec![link("base"), link("tip")], vec![parts]).unwrap();
    /// let ends = (robot.root(), robot.find_link("tip").unwrap());
    /// let mut solver = IkSolver::new(Arm::new(&robot, ends, Pose::identity())?); // goes from 0 to 0.5 m
    /// let target = IkTarget {
    ///     base_from_tcp: Pose::from_parts(Matrix3::identity(), Vector3::new(0.7, 0., 0.)),
    ///     part: TargetPart::Position,
    /// };
    /// let (inside, at_limit) = (ArmQ::from([0.4]), ArmQ::from([0.5]));
    /// for method in [DifferentialMethod::PseudoInverse, DifferentialMethod::Transpose] {
    ///     let step = solver.change_towards(&target, (&inside, &inside), method)?;
    ///     assert!((step.change[0] - 0.3).abs() < 1e-15 && step.limits_held.is_empty());
    ///     let step = solver.change_towards(&target, (&inside, &at_limit), method)?;
    ///     assert_eq!((step.change, step.limits_held), ([0.0].as_slice(), [0].as_slice()));
    /// }
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn change_towards(
        &mut self,
        target: &IkTarget,
        (q, commanded): (&ArmQ, &ArmQ),
        method: DifferentialMethod,
    ) -> Result<IkChange<'_>, KinematicsError> {
        KinematicsError::check_joints(self.q.len(), q)?;
        KinematicsError::check_joints(self.q.len(), commanded)?;
        self.q.copy_from_slice(q);
        let (frame, rule): (_, fn(&IkTask<'_>, &mut [f64])) = match method {
            DifferentialMethod::PseudoInverse => (IkMethod::PseudoInverse, step::damped_pseudo_inverse),
            DifferentialMethod::Transpose => (IkMethod::Transpose, step::transposed),
        };
        let frame = TaskFrame::of(frame, target.part, self.arm.metres_per_rad());
        let residual = self.look(target, &frame)?;
        self.q.copy_from_slice(commanded);
        self.hold(&residual);
        self.follow(rule, &residual);
        self.limits_held.clear();
        let held = self.held.iter().enumerate().filter(|(_, held)| **held);
        self.limits_held.extend(held.map(|(index, _)| index));
        Ok(IkChange {
            change: &self.change,
            residual_position_m: residual.position_m,
            residual_orientation_rad: residual.orientation_rad,
            limits_held: &self.limits_held,
        })
    }

    /// The configuration that was found last.
    pub(super) fn solution(&self) -> &ArmQ {
        &self.best
    }

    /// Takes whole turns out of the solution, as near to `start` as the limits allow; gives the sum of
    /// squares of the difference of the two, in radians.
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

    /// Writes the best configuration to `best`; gives its residual and the number of steps.
    fn search(
        &mut self,
        target: &IkTarget,
        options: &IkOptions,
        mut keep_going: impl FnMut() -> bool,
    ) -> Result<(IkResidual, usize), KinematicsError> {
        let frame = TaskFrame::of(options.method, target.part, self.arm.metres_per_rad());
        let mut residual = self.look(target, &frame)?;
        let mut best = residual;
        self.best.copy_from_slice(&self.q);
        let mut attempt = Attempt::starting_at(residual.cost());
        let mut random = None;
        for iteration in 0..options.max_iterations {
            if best.within(options) || !keep_going() {
                return Ok((best, iteration));
            }
            if options.method == IkMethod::LevenbergMarquardt && attempt.is_stuck() {
                let random = random.get_or_insert_with(|| Uniform::seeded(options.seed));
                self.arm.draw(random, &mut self.q);
                residual = self.look(target, &frame)?;
                attempt = Attempt::starting_at(residual.cost());
            } else {
                let moved = self.step(options.method, &residual);
                if options.method != IkMethod::LevenbergMarquardt && moved <= STANDSTILL {
                    return Ok((best, iteration));
                }
                residual = self.look(target, &frame)?;
                attempt.observe(residual.cost());
            }
            if residual.cost() < best.cost() || residual.within(options) {
                best = residual;
                self.best.copy_from_slice(&self.q);
            }
        }
        Ok((best, options.max_iterations))
    }

    /// Residual and columns at `q`.
    fn look(&mut self, target: &IkTarget, frame: &TaskFrame) -> Result<IkResidual, KinematicsError> {
        let (base_from_tcp, columns) = self.arm.pose_and_jacobian(&self.q)?;
        for (task, column) in self.columns.iter_mut().zip(columns) {
            *task = frame.column(column, &base_from_tcp, target.part);
        }
        Ok(IkResidual::of(target, &base_from_tcp, frame))
    }

    /// Moves `q` by one step, within the limits; gives the longest change.
    fn step(&mut self, method: IkMethod, residual: &IkResidual) -> f64 {
        self.hold(residual);
        let rule = match method {
            IkMethod::LevenbergMarquardt => step::damped,
            IkMethod::Newton | IkMethod::PseudoInverse => step::pseudo_inverse,
            IkMethod::Transpose => step::transposed,
        };
        self.follow(rule, residual);
        let mut longest: f64 = 0.0;
        for ((q, joint), change) in self.q.iter_mut().zip(self.arm.joints()).zip(&self.change) {
            let before = std::mem::replace(q, joint.inside(*q + change));
            longest = longest.max((*q - before).abs());
        }
        longest
    }

    /// Marks the joints that stand at a limit in `q` and that the residual pushes against it.
    fn hold(&mut self, residual: &IkResidual) {
        for (at, joint) in self.arm.joints().iter().enumerate() {
            let pull = self.columns[at].dot(&residual.task);
            let q = self.q[at];
            self.held[at] = (q <= joint.lower && pull < 0.0) || (q >= joint.upper && pull > 0.0);
        }
    }

    /// Writes the change of the joints that a rule finds to `change`.
    fn follow(&mut self, rule: fn(&IkTask<'_>, &mut [f64]), residual: &IkResidual) {
        let task = IkTask {
            columns: &self.columns,
            held: &self.held,
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
