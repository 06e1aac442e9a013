//! A jump of one joint's zero while the run goes on: an encoder that lost counts, a coupling that slipped.
//!
//! Of the errors of measured poses, the mean of some after an instant minus that of as many before it is explained by one column of
//! the Jacobian. Errors of the geometry cancel, since the arm hardly moves in between. Only poses that were measured can show it:
//! a controller computes its own from the same encoders.

use std::collections::VecDeque;

use congruent_description::JointKind;
use congruent_input::{Quantity, SiUnit, display::quantity};
use congruent_kinematics::{JacobianKind, Twist, UrdfTree};
use congruent_scenario::{PoseOrigin, StepCheck};
use nalgebra::{Vector3, Vector6};

use crate::{
    CheckContext, ComparedPoses, Names, PoseSample,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::{Watch, WatchedInstant},
};

/// Default limits: 0.05 deg and 0.5 mm. Kind: judgement; a tenth of what an arm loses by a tooth of its gears.
const ANGLE_RAD: f64 = 8.7e-4;
const SHIFT_M: f64 = 5e-4;
/// Poses on either side of an instant.
const SIDE: usize = 4;
/// Poses that are farther apart than this are not those of one instant, s.
const FARTHEST_S: f64 = 0.5;
/// A jump counts if it is larger than so many times the scatter of apparent jumps. Kind: statistics; one in 1e8 for normal errors.
const SCATTERS: f64 = 6.0;
/// Apparent jumps by which the scatter is known.
const FEWEST: u64 = 30;
/// Share of the change that a joint must explain.
const EXPLAINED: f64 = 0.8;
/// A length that makes rotations and positions one number, m: the reach of a wrist.
const LENGTH_M: f64 = 0.3;

/// The default limits, rad and m.
pub(crate) fn default_jumps() -> [f64; 2] {
    [ANGLE_RAD, SHIFT_M]
}

/// The error of a pose, m and `LENGTH_M` times rad, with its instant.
#[derive(Debug, Clone)]
struct PoseErrorAt {
    time_s: f64,
    error: Vector6<f64>,
    /// By how much each joint changes the error.
    columns: Vec<Vector6<f64>>,
    q: Vec<f64>,
}

/// A jump beyond the scatter.
#[derive(Debug, Clone)]
struct Jump {
    joint: usize,
    size: f64,
    at: PoseErrorAt,
}

/// The apparent jumps of one joint so far.
#[derive(Debug, Clone, Copy, Default)]
struct Scatter {
    count: u64,
    squares: f64,
}

impl Scatter {
    #[expect(clippy::cast_precision_loss, reason = "no log has 2^52 poses")]
    fn rms(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }
}

pub(crate) struct StepMonitor<'a> {
    poses: &'a [ComparedPoses],
    tree: UrdfTree,
    kinds: Vec<JointKind>,
    twists: Vec<Twist>,
    /// The last errors of each selection.
    errors: Vec<VecDeque<PoseErrorAt>>,
    scatter: Vec<Scatter>,
    /// The largest jump of those that follow each other, while there is one: an instant beside the jump shows a part of it.
    candidate: Option<Jump>,
    angle: Watch,
    shift: Watch,
    compared: u64,
}

impl<'a> StepMonitor<'a> {
    pub(crate) fn new(check: &StepCheck, context: &CheckContext<'a>) -> Self {
        let dof = context.dof();
        let [angle_rad, shift_m] = check.limits();
        let watch = |quantity, unit, limit| Watch::new(quantity, unit, Bound::AtMost, limit, dof);
        Self {
            poses: context.poses,
            tree: UrdfTree::new(&context.description.robot),
            kinds: context.joint_kinds(),
            twists: vec![Twist::zero(); dof],
            errors: vec![VecDeque::with_capacity(2 * SIDE + 1); context.poses.len()],
            scatter: vec![Scatter::default(); dof],
            candidate: None,
            angle: watch(Quantity::JumpOfAngle, SiUnit::Radian, angle_rad.unwrap_or(ANGLE_RAD)),
            shift: watch(Quantity::JumpOfShift, SiUnit::Metre, shift_m.unwrap_or(SHIFT_M)),
            compared: 0,
        }
    }

    /// The error of a pose in the axes of its frame, with the columns of the joints.
    fn error(&mut self, pose: &PoseSample<'_>) -> Option<PoseErrorAt> {
        let compared = &self.poses[pose.of];
        let by_model = compared.frame_from_target(pose.root_from_links);
        let recorded = &pose.frame_from_target;
        let weight = if compared.position_only { 0.0 } else { LENGTH_M };
        let shift = recorded.translation.vector - by_model.translation.vector;
        let turn: Vector3<f64> = (recorded.rotation * by_model.rotation.inverse()).scaled_axis();
        let root_from_tip =
            self.tree.jacobian_into(pose.q, compared.link, JacobianKind::Geometric, &mut self.twists).ok()?;
        let frame_from_root = (pose.root_from_links[compared.from_link.get()].to_isometry()
            * compared.link_from_frame)
            .inverse();
        let arm = root_from_tip.rotation * compared.link_from_target.translation.vector;
        let column = |twist: &Twist| {
            let linear = frame_from_root.rotation * (twist.linear + twist.angular.cross(&arm));
            let angular = frame_from_root.rotation * twist.angular;
            stacked(&linear, &(weight * angular))
        };
        Some(PoseErrorAt {
            time_s: pose.time_s,
            error: stacked(&shift, &(weight * turn)),
            columns: self.twists.iter().map(column).collect(),
            q: pose.q.to_vec(),
        })
    }

    /// Judges the instant in the middle of the last errors.
    fn judge(&mut self, of: usize) {
        let errors = &self.errors[of];
        let (first, last) = (&errors[0], &errors[2 * SIDE - 1]);
        if errors.len() < 2 * SIDE || last.time_s - first.time_s > FARTHEST_S {
            return;
        }
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let mean = |from: usize| {
            errors.iter().skip(from).take(SIDE).map(|at| at.error).sum::<Vector6<f64>>() / SIDE as f64
        };
        let change = mean(SIDE) - mean(0);
        let at = &errors[SIDE];
        self.compared += 1;
        let best = at.columns.iter().enumerate().filter_map(|(joint, column)| {
            let size = column.norm_squared();
            let jump = column.dot(&change) / size;
            let left = (change - column * jump).norm();
            (size > 0.0).then_some((joint, jump, left))
        });
        let Some((joint, jump, left)) = best.min_by(|a, b| a.2.total_cmp(&b.2)) else { return };
        let is_explained = left <= (1.0 - EXPLAINED) * change.norm();
        let scatter = &mut self.scatter[joint];
        let is_known = scatter.count >= FEWEST;
        if is_explained && is_known && jump.abs() > SCATTERS * scatter.rms() {
            let is_larger = self.candidate.as_ref().is_none_or(|known| jump.abs() > known.size);
            if is_larger {
                self.candidate = Some(Jump { joint, size: jump.abs(), at: at.clone() });
            }
            return;
        }
        // Up to its largest part, what belongs to a jump is no scatter.
        if !is_known || jump.abs() <= SCATTERS * scatter.rms() {
            scatter.count += 1;
            scatter.squares += jump * jump;
        }
        let instant = WatchedInstant { time_s: at.time_s, q: &at.q };
        let watch = if self.kinds[joint].is_angular() { &mut self.angle } else { &mut self.shift };
        watch.observe_at(0.0, joint, instant);
        self.end_jump();
    }

    /// Takes the jump that has passed.
    fn end_jump(&mut self) {
        let Some(Jump { joint, size, at }) = self.candidate.take() else { return };
        let watch = if self.kinds[joint].is_angular() { &mut self.angle } else { &mut self.shift };
        watch.observe_at(size, joint, WatchedInstant { time_s: at.time_s, q: &at.q });
    }

    /// What is too small to be distinguished from the scatter of the poses.
    fn level(&self, names: &Names) -> Option<String> {
        let angular = self
            .scatter
            .iter()
            .zip(&self.kinds)
            .enumerate()
            .filter(|(_, (scatter, kind))| kind.is_angular() && scatter.count >= FEWEST);
        let (joint, (scatter, _)) = angular.max_by(|a, b| a.1.0.rms().total_cmp(&b.1.0.rms()))?;
        let level = quantity((SCATTERS * scatter.rms()).to_degrees(), "deg");
        Some(format!(
            "jumps below {level} cannot be distinguished from the scatter of the poses ({})",
            names.joints[joint]
        ))
    }
}

fn stacked(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

impl Monitor for StepMonitor<'_> {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if sample.is_last {
            self.end_jump();
        }
    }

    fn observe_pose(&mut self, pose: &PoseSample<'_>) {
        if self.poses[pose.of].origin != PoseOrigin::Measured {
            return;
        }
        let Some(error) = self.error(pose) else { return };
        let errors = &mut self.errors[pose.of];
        if errors.len() == 2 * SIDE {
            errors.pop_front();
        }
        errors.push_back(error);
        if errors.len() == 2 * SIDE {
            self.judge(pose.of);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |joint: usize| names.joints[joint].clone();
        let watches = [(&self.angle, true), (&self.shift, false)];
        let has = |angular: bool| self.kinds.iter().any(|kind| kind.is_angular() == angular);
        let measures = watches.into_iter().filter(|(_, angular)| has(*angular));
        let mut notes = Vec::new();
        if self.poses.iter().all(|poses| poses.origin != PoseOrigin::Measured) {
            notes.push("a jump of an encoder cannot be seen without measured poses: others are computed from the encoders".to_owned());
        }
        notes.extend(self.level(names));
        Observed {
            samples: self.compared,
            measures: measures.map(|(watch, _)| watch.measure(&names.joints, name)).collect(),
            notes,
            ..Observed::default()
        }
    }

    fn has_failed(&self) -> bool {
        self.angle.is_violated() || self.shift.is_violated()
    }
}
