//! A jump of one joint's zero while the run goes on: an encoder that lost counts, a coupling that slipped.
//!
//! Of the errors of measured poses, the mean of some after an instant minus that of as many before it, less what the errors change
//! anyhow, is explained by one column of the Jacobian. Errors of geometry and frames, which change slowly as the arm moves, cancel.
//! It counts if it is far beyond the scatter of the errors, which is estimated by its median: jumps do not change that. Only poses
//! that were measured can show it: a controller computes its own from the same encoders.

use std::collections::VecDeque;

use congruent_description::JointKind;
use congruent_input::{Quantity, SiUnit, display::angle};
use congruent_kinematics::{JacobianKind, Twist, UrdfTree};
use congruent_scenario::{PoseOrigin, StepCheck};
use nalgebra::{Vector3, Vector6};

use super::scatter::Scatter;
use crate::{
    CheckContext, ComparedPoses, Names, PoseSample,
    monitor::{Monitor, Observed},
    sample::Sample,
    verdict::Bound,
    watch::{Watch, WatchedInstant},
};

/// Default limits: 0.1 deg and 1 mm. Kind: judgement; a fifth of what an arm loses by a tooth of its gears, and what trackers show
/// within a fraction of a second.
const ANGLE_RAD: f64 = 1.745_329_251_994_329_5e-3;
const SHIFT_M: f64 = 1e-3;
/// Poses of one mean; there are two means on either side of an instant.
const BLOCK: usize = 4;
/// Poses that are farther apart than this are not those of one instant, s.
const FARTHEST_S: f64 = 1.0;
/// A jump is so many times the standard deviation of what the scatter alone would show. Kind: statistics; one in 1e10 for normal
/// errors, of which there are some correlated thousands.
const SIGMAS: f64 = 7.0;
/// Share of what is beyond the scatter that a joint must explain, as squares.
const EXPLAINED: f64 = 0.8;
/// A joint that moves the target by less is not seen, m/rad or m/m.
const SMALLEST_COLUMN: f64 = 0.02;
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

/// The errors of one selection of poses.
#[derive(Debug, Clone, Default)]
struct ErrorTrack {
    last: VecDeque<PoseErrorAt>,
    /// Of the change of the errors: of its position, of its rotation.
    scatter: [Scatter; 2],
    /// The largest jump of those that follow each other: an instant beside the jump shows a part of it.
    candidate: Option<Jump>,
}

/// What of a joint could be seen.
#[derive(Debug, Clone, Copy, Default)]
struct SeenJoint {
    /// Sum and number of the smallest jumps that would count.
    level: f64,
    count: u64,
}

pub(crate) struct StepMonitor<'a> {
    poses: &'a [ComparedPoses],
    tree: UrdfTree,
    kinds: Vec<JointKind>,
    twists: Vec<Twist>,
    tracks: Vec<ErrorTrack>,
    seen: Vec<SeenJoint>,
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
            tracks: vec![ErrorTrack::default(); context.poses.len()],
            seen: vec![SeenJoint::default(); dof],
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
        let geometric = JacobianKind::Geometric;
        let root_from_link =
            self.tree.jacobian_into(pose.q, compared.link, geometric, &mut self.twists).ok()?;
        let root_from_frame =
            pose.root_from_links[compared.from_link.get()].to_isometry() * compared.link_from_frame;
        let to_frame = root_from_frame.rotation.inverse();
        let arm = root_from_link.rotation * compared.link_from_target.translation.vector;
        let column = |twist: &Twist| {
            let linear = to_frame * (twist.linear + twist.angular.cross(&arm));
            stacked(&linear, &(weight * (to_frame * twist.angular)))
        };
        Some(PoseErrorAt {
            time_s: pose.time_s,
            error: stacked(&shift, &(weight * turn)),
            columns: self.twists.iter().map(column).collect(),
            q: pose.q.to_vec(),
        })
    }

    /// Judges the instant in the middle of the last errors of a selection.
    fn judge(&mut self, of: usize) {
        let track = &mut self.tracks[of];
        let errors = &track.last;
        if errors[4 * BLOCK - 1].time_s - errors[0].time_s > FARTHEST_S {
            return;
        }
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let mean = |block: usize| {
            let of_block = errors.iter().skip(block * BLOCK).take(BLOCK);
            of_block.map(|at| at.error).sum::<Vector6<f64>>() / BLOCK as f64
        };
        // Without what would go on as it did: the difference of the outer means is three times that of a line.
        let change = (mean(2) - mean(1)) * 1.5 - (mean(3) - mean(0)) * 0.5;
        let at = errors[2 * BLOCK].clone();
        let [position, rotation] = &mut track.scatter;
        let sigmas = [position.sigma(), rotation.sigma()];
        for (row, part) in change.iter().enumerate() {
            if row < 3 { position.take(*part) } else { rotation.take(*part) }
        }
        let [Some(of_position), of_rotation] = sigmas else { return };
        self.compared += 1;
        // Without rotations their rows are 0, and have no scatter.
        let weights =
            [1.0 / of_position, of_rotation.filter(|sigma| *sigma > 0.0).map_or(0.0, |sigma| 1.0 / sigma)];
        let found = self.best_joint(&at, &change, weights);
        let track = &mut self.tracks[of];
        if let Some(jump) = found {
            if track.candidate.as_ref().is_none_or(|known| jump.size > known.size) {
                track.candidate = Some(jump);
            }
            return;
        }
        let passed = track.candidate.take();
        self.nothing_at(&at);
        self.take_jump(passed);
    }

    /// The joint whose jump explains a change that is beyond the scatter.
    fn best_joint(&mut self, at: &PoseErrorAt, change: &Vector6<f64>, weights: [f64; 2]) -> Option<Jump> {
        let weighted =
            |vector: &Vector6<f64>| Vector6::from_fn(|row, _| vector[row] * weights[usize::from(row >= 3)]);
        let white = weighted(change);
        let mut best: Option<(f64, usize, f64)> = None;
        for (joint, column) in at.columns.iter().enumerate() {
            if column.norm() < SMALLEST_COLUMN {
                continue;
            }
            let column = weighted(column);
            let size = column.norm();
            let seen = &mut self.seen[joint];
            (seen.level, seen.count) = (seen.level + SIGMAS / size, seen.count + 1);
            let explained = column.dot(&white) / size;
            if best.is_none_or(|(known, ..)| explained.abs() > known) {
                best = Some((explained.abs(), joint, (explained / size).abs()));
            }
        }
        let (explained, joint, size) = best?;
        // Six components scatter by one each: what is beyond that must be the joint's.
        let beyond = (white.norm_squared() - 6.0).max(0.0);
        let is_jump = explained > SIGMAS && explained * explained >= EXPLAINED * beyond;
        is_jump.then(|| Jump { joint, size, at: at.clone() })
    }

    /// An instant without a jump, so that the check has a value.
    fn nothing_at(&mut self, at: &PoseErrorAt) {
        let angular = self.kinds.iter().position(|kind| kind.is_angular());
        let (watch, joint) = match angular {
            Some(joint) => (&mut self.angle, joint),
            None => (&mut self.shift, 0),
        };
        watch.observe_at(0.0, joint, WatchedInstant { time_s: at.time_s, q: &at.q });
    }

    fn take_jump(&mut self, jump: Option<Jump>) {
        let Some(Jump { joint, size, at }) = jump else { return };
        let watch = if self.kinds[joint].is_angular() { &mut self.angle } else { &mut self.shift };
        watch.observe_at(size, joint, WatchedInstant { time_s: at.time_s, q: &at.q });
    }

    /// For each joint the smallest jump that would be seen, on average; `None` for one that moves no target.
    fn levels(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        #[expect(clippy::cast_precision_loss, reason = "no log has 2^52 poses")]
        self.seen.iter().map(|seen| (seen.count > 0).then(|| seen.level / seen.count as f64))
    }

    fn limit(&self, joint: usize) -> f64 {
        if self.kinds[joint].is_angular() { self.angle.limit() } else { self.shift.limit() }
    }

    /// Which jumps the poses cannot show.
    fn notes(&self, names: &Names) -> Vec<String> {
        if self.poses.iter().all(|poses| poses.origin != PoseOrigin::Measured) {
            return vec![
                "a jump of an encoder cannot be seen without measured poses: others are computed from the encoders"
                    .to_owned(),
            ];
        }
        let unseen = self.levels().enumerate().filter_map(|(joint, level)| {
            let name = &names.joints[joint];
            let level = level.filter(|&level| level > self.limit(joint))?;
            let level = if self.kinds[joint].is_angular() {
                angle(level)
            } else {
                congruent_input::display::length(level)
            };
            Some(format!("{name} {level}"))
        });
        let unseen: Vec<String> = unseen.collect();
        if unseen.is_empty() {
            return Vec::new();
        }
        vec![format!(
            "the smallest jumps that the scatter of the poses shows are above the limit: {}",
            unseen.join(", ")
        )]
    }
}

fn stacked(linear: &Vector3<f64>, angular: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z)
}

impl Monitor for StepMonitor<'_> {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if sample.is_last {
            self.end(sample);
        }
    }

    fn end(&mut self, _sample: &Sample<'_>) {
        for of in 0..self.tracks.len() {
            let jump = self.tracks[of].candidate.take();
            self.take_jump(jump);
        }
    }

    fn observe_pose(&mut self, pose: &PoseSample<'_>) {
        if self.poses[pose.of].origin != PoseOrigin::Measured {
            return;
        }
        let Some(error) = self.error(pose) else { return };
        let last = &mut self.tracks[pose.of].last;
        if last.len() == 4 * BLOCK {
            last.pop_front();
        }
        last.push_back(error);
        if last.len() == 4 * BLOCK {
            self.judge(pose.of);
        }
    }

    fn finish(&self, names: &Names) -> Observed {
        let name = |joint: usize| names.joints[joint].clone();
        let watches = [&self.angle, &self.shift].into_iter().filter(|watch| watch.worst().is_some());
        let mut measures: Vec<_> = watches.map(|watch| watch.measure(&names.joints, name)).collect();
        if measures.is_empty() {
            measures.push(self.angle.measure(&names.joints, name));
        }
        // A joint of which a jump at the limit would not be seen is not judged; if all are such, nothing was.
        let is_seen =
            |(joint, level): (usize, Option<f64>)| level.is_some_and(|level| level <= self.limit(joint));
        let is_judged = self.levels().enumerate().any(is_seen) || self.has_failed();
        let (samples, not_evaluated) = if is_judged { (self.compared, 0) } else { (0, self.compared) };
        Observed { samples, not_evaluated, measures, notes: self.notes(names), ..Observed::default() }
    }

    fn has_failed(&self) -> bool {
        self.angle.is_violated() || self.shift.is_violated()
    }
}
