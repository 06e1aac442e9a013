//! A log as a source of joint states: its rows one after another, and its poses at their own instants.

use std::collections::VecDeque;

use congruent_description::{Robot, RobotQ};
use congruent_logs::{EventTime, LiveReader, LogStream, StreamEvent, StreamedPose};
use congruent_monitors::{JointSample, JointStateView, LeftOutInstants, SetpointView};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::{
    joint_states::{Advance, JointStateSource, SourceError, SourcePose},
    stream_progress::{StreamPosition, StreamProgress},
};
use crate::{codes, setup::RecordedSetup};

/// How long rows are kept for poses that come later in the log, s.
const KEPT_S: f64 = 3.0;
/// Most rows that are kept: those of 3 s at 4 kHz.
const MOST_KEPT: usize = 12_000;
/// Most poses that wait for a row: a stream may have poses and no joints for hours.
const MOST_WAITING: usize = 100_000;

/// The joints at one instant of the log.
#[derive(Debug, Clone)]
struct RecordedJoints {
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    /// Torques and forces; NaN where efforts are something else.
    effort: Vec<f64>,
    /// As recorded, whatever they are.
    recorded_effort: Vec<f64>,
    setpoint_q: RobotQ,
    setpoint_qd: Vec<f64>,
    left_out: LeftOutInstants,
    begins_part: bool,
    message: EventTime,
}

/// A log, instant after instant.
pub struct RecordedSource<'a> {
    setup: &'a RecordedSetup,
    robot: &'a Robot,
    /// Positions of joints that the log does not have.
    start: &'a RobotQ,
    stream: LogStream,
    /// Joints that some topic has.
    is_recorded: Vec<bool>,
    /// Joints whose efforts are torques and forces.
    is_torque: Vec<bool>,
    now: RecordedJoints,
    next: RecordedJoints,
    has_next: bool,
    is_gap_given: bool,
    /// Of a stream. Its next row is read when it is wanted: the answer to a sample must not wait for it.
    live: Option<StreamProgress>,
    /// Positions of the last rows, the latest at the end.
    kept: VecDeque<(f64, RobotQ)>,
    /// Poses that are later than the rows so far, in the order of their times.
    waiting: VecDeque<StreamedPose>,
    pose_q: RobotQ,
    no_accelerations: Vec<f64>,
}

impl std::fmt::Debug for RecordedSource<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RecordedSource").field("time_s", &self.now.time_s).finish_non_exhaustive()
    }
}

impl<'a> RecordedSource<'a> {
    /// The log at its first row.
    ///
    /// # Errors
    /// The log cannot be read, or has no row.
    pub fn new(setup: &'a RecordedSetup, robot: &'a Robot, start: &'a RobotQ) -> Result<Self, SourceError> {
        let stream = LogStream::open(&setup.path, &setup.options, setup.selection.clone());
        Self::begin(setup, robot, start, stream.map_err(SourceError::new)?).at_first_row()
    }

    /// A stream at its first row; `state` is kept at how far it has come.
    ///
    /// # Errors
    /// The stream cannot be read, or ends without a row.
    pub fn live(
        setup: &'a RecordedSetup,
        robot: &'a Robot,
        start: &'a RobotQ,
        reader: LiveReader,
        state: StreamProgress,
    ) -> Result<Self, SourceError> {
        let stream = LogStream::new(Box::new(reader), setup.selection.clone());
        Self { live: Some(state), ..Self::begin(setup, robot, start, stream) }.at_first_row()
    }

    fn begin(setup: &'a RecordedSetup, robot: &'a Robot, start: &'a RobotQ, stream: LogStream) -> Self {
        let dof = robot.dof();
        let joints = RecordedJoints {
            time_s: 0.0,
            q: start.clone(),
            qd: vec![f64::NAN; dof],
            effort: vec![f64::NAN; dof],
            recorded_effort: vec![f64::NAN; dof],
            setpoint_q: start.clone(),
            setpoint_qd: vec![f64::NAN; dof],
            left_out: LeftOutInstants::default(),
            begins_part: false,
            message: EventTime::default(),
        };
        let measured = setup.selection.joints.iter().filter(|topic| !topic.is_setpoint);
        let (mut is_recorded, mut is_torque) = (vec![false; dof], vec![false; dof]);
        for (topic, joint) in measured.flat_map(|topic| topic.joints.iter().map(move |joint| (topic, joint)))
        {
            is_recorded[joint.joint] = true;
            is_torque[joint.joint] = topic.effort_is_torque;
        }
        Self {
            setup,
            robot,
            start,
            stream,
            is_recorded,
            is_torque,
            now: joints.clone(),
            next: joints,
            has_next: true,
            is_gap_given: false,
            live: None,
            kept: VecDeque::new(),
            waiting: VecDeque::new(),
            pose_q: start.clone(),
            no_accelerations: vec![0.0; dof],
        }
    }

    fn at_first_row(mut self) -> Result<Self, SourceError> {
        self.read()?;
        if !self.has_next {
            return Err(SourceError::new(self.nothing()));
        }
        self.take_next()?;
        Ok(self)
    }

    fn nothing(&self) -> congruent_input::Diagnostic {
        let counts = self.stream.joint_counts();
        let message = format!(
            "{}: no instant has a position of every joint that is taken; {} were left out",
            self.setup.path.display(),
            counts.incomplete
        );
        congruent_input::Diagnostic::error(codes::scenario::LOGGED_NOTHING, message).with_help(
            "`congruent describe LOG --robot ROBOT` shows the topics, their times and their joints",
        )
    }

    /// Reads on to the next row; poses between wait.
    fn read(&mut self) -> Result<(), SourceError> {
        loop {
            match self.stream.next_event().map_err(SourceError::new)? {
                Some(StreamEvent::Row) => {
                    self.fill_next();
                    return Ok(());
                }
                Some(StreamEvent::Pose(pose)) => {
                    let later = self.waiting.iter().rev().take_while(|of| of.time_s > pose.time_s).count();
                    self.waiting.insert(self.waiting.len() - later, pose);
                    if self.waiting.len() > MOST_WAITING {
                        self.waiting.pop_front();
                    }
                }
                None => {
                    self.has_next = false;
                    self.say_how_far();
                    return Ok(());
                }
            }
        }
    }

    fn fill_next(&mut self) {
        let (row, next) = (self.stream.row(), &mut self.next);
        next.time_s = row.time_s;
        next.left_out = LeftOutInstants { incomplete: row.left_out, unusable: row.unusable };
        (next.begins_part, next.message) = (self.stream.begins_part(), row.message);
        next.qd.copy_from_slice(&row.qd);
        // Joints that the log does not have stay where they are.
        let held = next.qd.iter_mut().zip(&self.is_recorded).filter(|(_, is_recorded)| !**is_recorded);
        held.for_each(|(qd, _)| *qd = 0.0);
        // A follower that the log does not have moves with its master.
        self.robot.apply_mimic_to_speeds(&mut next.qd);
        let recorded = next.qd.iter_mut().zip(&row.qd).zip(&self.is_recorded);
        recorded.filter(|(_, is_recorded)| **is_recorded).for_each(|((qd, of_log), _)| *qd = *of_log);
        next.recorded_effort.copy_from_slice(&row.effort);
        let torques = next.effort.iter_mut().zip(&row.effort).zip(&self.is_torque);
        torques.for_each(|((torque, recorded), is_torque)| {
            *torque = if *is_torque { *recorded } else { f64::NAN };
        });
        next.setpoint_qd.copy_from_slice(&row.setpoint_qd);
        for (q, recorded, start) in
            [(&mut next.q, &row.q, true), (&mut next.setpoint_q, &row.setpoint_q, false)]
        {
            let held = |at: usize| if start { self.start[at] } else { f64::NAN };
            let known = |at: usize, value: f64| if value.is_nan() { held(at) } else { value };
            q.iter_mut().enumerate().for_each(|(at, q)| *q = known(at, recorded[at]));
        }
        // A follower that the log does not have is where its master puts it.
        self.robot.apply_mimic(&mut next.q);
        let measured = next.q.iter_mut().zip(&row.q).zip(&self.is_recorded);
        measured
            .filter(|((_, recorded), is_recorded)| **is_recorded && !recorded.is_nan())
            .for_each(|((q, recorded), _)| *q = *recorded);
    }

    /// Goes on to the row that was read.
    fn take_next(&mut self) -> Result<(), SourceError> {
        std::mem::swap(&mut self.now, &mut self.next);
        self.is_gap_given = false;
        self.say_how_far();
        self.keep_positions();
        if self.live.is_some() { Ok(()) } else { self.read() }
    }

    /// Keeps the positions of this row for poses that come later.
    fn keep_positions(&mut self) {
        if !self.waits_for_poses() {
            return;
        }
        let oldest_s = self.now.time_s - KEPT_S;
        let is_old = |(time_s, _): &(f64, RobotQ)| *time_s < oldest_s;
        let reused = if self.kept.front().is_some_and(is_old) || self.kept.len() == MOST_KEPT {
            self.kept.pop_front()
        } else {
            None
        };
        let mut q = reused.map_or_else(|| self.now.q.clone(), |(_, q)| q);
        q.copy_from_slice(&self.now.q);
        self.kept.push_back((self.now.time_s, q));
    }

    fn say_how_far(&self) {
        if let Some(state) = &self.live {
            state.set(StreamPosition { message: self.now.message, counts: self.stream.joint_counts() });
        }
    }

    fn waits_for_poses(&self) -> bool {
        !self.setup.poses.is_empty()
    }

    /// The positions at an instant between two rows that are kept; `None` if it is in a gap, or before them.
    fn interpolate(&mut self, time_s: f64) -> Option<()> {
        let after = self.kept.partition_point(|(at_s, _)| *at_s < time_s);
        let (after_s, after_q) = self.kept.get(after)?;
        #[expect(clippy::float_cmp, reason = "the time of one row")]
        if *after_s == time_s {
            self.pose_q.copy_from_slice(after_q);
            return Some(());
        }
        let (before_s, before_q) = self.kept.get(after.checked_sub(1)?)?;
        let gap_s = after_s - before_s;
        if gap_s > self.setup.selection.maximum_gap_s() {
            return None;
        }
        let share = (time_s - before_s) / gap_s;
        let pairs = before_q.iter().zip(after_q.iter());
        self.pose_q
            .iter_mut()
            .zip(pairs)
            .for_each(|(q, (before, after))| *q = before + share * (after - before));
        Some(())
    }
}

impl JointStateSource for RecordedSource<'_> {
    fn start_s(&self) -> f64 {
        self.now.time_s
    }

    fn joints(&self) -> JointSample<'_> {
        let RecordedJoints { q, qd, effort, recorded_effort, setpoint_q, setpoint_qd, .. } = &self.now;
        let known = |values: &'_ Vec<f64>| {
            let recorded = values.iter().zip(&self.is_recorded).filter(|(_, is_recorded)| **is_recorded);
            recorded.into_iter().any(|(value, _)| !value.is_nan())
        };
        let has_setpoint =
            setpoint_q.iter().zip(&self.is_recorded).all(|(q, is_recorded)| !is_recorded || !q.is_nan())
                && setpoint_q.iter().any(|q| !q.is_nan());
        let setpoint = has_setpoint.then_some(SetpointView {
            q: setpoint_q,
            qd: setpoint_qd,
            qdd: &self.no_accelerations,
            effort: &[],
        });
        let (qd, effort) =
            (if known(qd) { &qd[..] } else { &[] }, if known(effort) { &effort[..] } else { &[] });
        let recorded_effort = if known(recorded_effort) { &recorded_effort[..] } else { &[] };
        JointSample { truth: None, measured: JointStateView { q, qd, effort }, setpoint, recorded_effort }
    }

    fn left_out(&self) -> LeftOutInstants {
        self.now.left_out
    }

    fn left_out_after(&self) -> LeftOutInstants {
        if self.has_next {
            return LeftOutInstants::default();
        }
        let [incomplete, unusable] = self.stream.left_out_since_row();
        LeftOutInstants { incomplete, unusable }
    }

    fn begins_part(&self) -> bool {
        self.now.begins_part
    }

    fn advance(&mut self, _wanted_s: f64) -> Result<Advance, SourceError> {
        // Behind a gap the next row was read already.
        if self.live.is_some() && !self.is_gap_given {
            self.read()?;
        }
        if !self.has_next {
            return Ok(Advance::End);
        }
        let (from_s, to_s) = (self.now.time_s, self.next.time_s);
        if to_s - from_s > self.setup.selection.maximum_gap_s() && !self.is_gap_given {
            self.is_gap_given = true;
            return Ok(Advance::Gap { from_s, to_s });
        }
        self.take_next()?;
        Ok(Advance::At(to_s))
    }

    fn is_last(&self) -> bool {
        // Nobody knows of a stream whether more comes.
        self.live.is_none() && !self.has_next
    }

    fn next_pose(&mut self) -> Option<SourcePose<'_>> {
        loop {
            let pose = *self.waiting.front().filter(|pose| pose.time_s <= self.now.time_s)?;
            self.waiting.pop_front();
            if self.interpolate(pose.time_s).is_none() {
                continue;
            }
            let [x, y, z] = pose.target_in_frame_m;
            let [w, i, j, k] = pose.frame_from_target_wxyz;
            let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
            return Some(SourcePose {
                of: pose.selection,
                time_s: pose.time_s,
                frame_from_target: Isometry3::from_parts(Translation3::new(x, y, z), rotation),
                q: &self.pose_q,
            });
        }
    }
}
