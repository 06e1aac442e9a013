//! The motions of a scenario, one after another. Moves are planned when the scenario is checked, servos are
//! computed in the run (`reference_generator.rs`).

use congruent_description::{RobotDescription, RobotQ};
use congruent_input::{Diagnostic, Findings};
use congruent_scenario::{FilePlace, MotionSettings, ScenarioFolder};

use super::{
    joints::{joint_move, joint_path, playback},
    motion_plan::{Motion, MotionPlan, SetpointMut},
    planning::Planning,
    tcp::{path, tcp_move, tcp_servo},
    timing::MotionLimits,
};
use crate::codes;

/// The motions of a scenario, with their places in the file and the limits that they keep.
#[derive(Debug, Clone, Copy)]
pub struct MotionInput<'a> {
    /// The motions, one after another.
    pub motions: &'a [MotionSettings],
    /// Where they stand in the file.
    pub places: FilePlace<'a>,
    /// Velocity, acceleration and jerk that motions keep.
    pub limits: &'a MotionLimits,
    /// The folder in which files that a motion names are found.
    pub folder: ScenarioFolder<'a>,
}

/// All motions of a scenario; the arm holds before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    pub(super) start: RobotQ,
    pub(super) motions: Vec<Motion>,
    /// Start time of each motion.
    pub(super) starts_s: Vec<f64>,
    /// Line of each motion in the scenario file.
    pub(super) lines: Vec<Option<usize>>,
    /// Limits of the moves that are planned during the run.
    pub limits: MotionLimits,
}

impl Trajectory {
    /// Plans the motions of a scenario, from the start configuration on.
    ///
    /// # Errors
    /// Every finding of the first motion that is wrong.
    pub fn new(
        input: MotionInput<'_>,
        description: &RobotDescription,
        start: &RobotQ,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Findings> {
        let MotionInput { motions, places, limits, folder } = input;
        let mut trajectory = Self {
            start: start.clone(),
            motions: Vec::new(),
            starts_s: Vec::new(),
            lines: (0..motions.len()).map(|index| places.item(index).line()).collect(),
            limits: limits.clone(),
        };
        while trajectory.motions.len() < motions.len() {
            let index = trajectory.motions.len();
            let (settings, place) = (&motions[index], places.item(index));
            // After a servo the start of a motion is known only during the run: it is planned then.
            if trajectory.ends_open() && !matches!(settings, MotionSettings::Servo(_)) {
                trajectory.push(open(settings, place)?);
                continue;
            }
            let from = trajectory.end().clone();
            let mut planning = Planning { description, limits, folder, from: &from, place: places, warnings };
            // One call may plan several: lines and arcs that blend are one path.
            for motion in plan(&motions[index..], index, &mut planning)? {
                trajectory.push(motion);
            }
        }
        Ok(trajectory)
    }

    fn push(&mut self, motion: Motion) {
        self.starts_s.push(self.duration_s());
        self.motions.push(motion);
    }

    /// The motions, one after another.
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// Start and duration of each motion, s.
    pub fn times(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.starts_s.iter().zip(&self.motions).map(|(&starts_s, motion)| (starts_s, motion.duration_s))
    }

    /// End of the last motion, s after the start of the run.
    pub fn duration_s(&self) -> f64 {
        match (self.starts_s.last(), self.motions.last()) {
            (Some(start_s), Some(motion)) => start_s + motion.duration_s,
            _ => 0.0,
        }
    }

    /// The planned positions at a time; `None` from the beginning of a servo on.
    pub fn planned_at(&self, time_s: f64) -> Option<RobotQ> {
        let Some((index, starts_s)) = self.under_way(time_s) else { return Some(self.start.clone()) };
        // Any before it, too: what follows a servo starts where the servo ends.
        if self.motions[..=index].iter().any(|motion| !matches!(motion.motion_plan, MotionPlan::Planned(_))) {
            return None;
        }
        let MotionPlan::Planned(planned) = &self.motions[index].motion_plan else { return None };
        let mut q = self.start.clone();
        let (mut qd, mut qdd) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        planned.at(time_s - starts_s, SetpointMut { q: &mut q, qd: &mut qd, qdd: &mut qdd });
        Some(q)
    }

    /// The accelerations that are declared for the joints, infinity for none.
    pub fn declared_accelerations(&self) -> &[f64] {
        &self.limits.declared_acceleration
    }

    /// Whether a motion is computed in the run.
    pub(super) fn has_servo(&self) -> bool {
        self.motions.iter().any(|motion| matches!(motion.motion_plan, MotionPlan::Servo(_)))
    }

    /// Whether the end of the last motion is known only in the run.
    pub(crate) fn ends_open(&self) -> bool {
        matches!(
            self.motions.last(),
            Some(Motion { motion_plan: MotionPlan::Servo(_) | MotionPlan::Open(_), .. })
        )
    }

    /// The end of the last motion whose end is known before the run.
    pub(super) fn end(&self) -> &RobotQ {
        let known = self.motions.iter().rev().find_map(|motion| match &motion.motion_plan {
            MotionPlan::Planned(planned) => Some(&planned.to),
            MotionPlan::Servo(_) | MotionPlan::Open(_) => None,
        });
        known.unwrap_or(&self.start)
    }

    /// The motion at `time_s` with the time of its start, also after its duration; `None` before the first.
    pub(super) fn under_way(&self, time_s: f64) -> Option<(usize, f64)> {
        let current = self.starts_s.partition_point(|&start_s| start_s <= time_s).checked_sub(1)?;
        Some((current, self.starts_s[current]))
    }
}

/// Plans the first of these motions, together with those that it blends into; `planning.place` is the list of all motions, in
/// which the first has this index.
pub(super) fn plan(
    motions: &[MotionSettings],
    first: usize,
    planning: &mut Planning<'_>,
) -> Result<Vec<Motion>, Findings> {
    // Before `place` is narrowed to one motion: a path marks each of its legs.
    let count = path::group_length(motions);
    if count > 0 {
        return Ok(path::plan(&motions[..count], first, planning)?);
    }
    planning.place = planning.place.item(first);
    let motion = match &motions[0] {
        MotionSettings::Joints(settings) => joint_move::plan(settings, planning)?,
        MotionSettings::Tcp(settings) => tcp_move::plan(settings, planning)?,
        MotionSettings::JointPath(settings) => joint_path::plan(settings, planning)?,
        MotionSettings::Playback(settings) => playback::plan(settings, planning)?,
        MotionSettings::Servo(settings) => tcp_servo::plan(settings, planning)?,
        MotionSettings::Line(_) | MotionSettings::Arc(_) | MotionSettings::TcpPath(_) => {
            unreachable!("a line or arc is a path")
        }
    };
    Ok(vec![motion])
}

/// A motion that is planned during the run: it starts at the end of a servo.
fn open(settings: &MotionSettings, place: FilePlace<'_>) -> Result<Motion, Diagnostic> {
    let refused = |message: &str, help: &str| {
        place.mark(Diagnostic::error(codes::scenario::AFTER_SERVO, message).with_help(help.to_owned()))
    };
    let blends = match settings {
        MotionSettings::Line(line) => line.blend_m > 0.0,
        MotionSettings::Arc(arc) => arc.blend_m > 0.0,
        _ => false,
    };
    if blends {
        let message = "a motion that starts at the end of a servo_tcp is planned alone and cannot blend into the next one";
        return Err(refused(message, "remove `blend_m`, or put the motions before the servo_tcp"));
    }
    let duration_s = settings.duration_s().ok_or_else(|| match settings {
        MotionSettings::Playback(_) | MotionSettings::TcpPath(_) => refused(
            "this motion cannot follow a servo_tcp, whose end is known only during the run",
            "put it before the servo_tcp, or move the joints after the servo_tcp instead",
        ),
        _ => refused(
            "the duration is unknown: the motion starts at the end of a servo_tcp, which is known only during the run",
            "give `duration_s`",
        ),
    })?;
    Ok(Motion { duration_s, motion_plan: MotionPlan::Open(Box::new(settings.clone())) })
}
