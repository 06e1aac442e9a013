//! The motions of a scenario, one after another. Moves are planned when the scenario is checked, servos are
//! computed in the run (`reference_generator.rs`).

use congruent_description::{Diagnostic, RobotDescription, RobotQ};

use super::{
    course::{Course, Motion, SetpointMut},
    joints::{joint_move, joint_path, playback},
    planning::Planning,
    tcp::{path, tcp_move, tcp_servo},
    timing::MotionLimits,
};
use crate::scenario::{FilePlace, MotionSettings, ScenarioFolder};

/// The motions of a scenario with what planning needs besides the robot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionInput<'a> {
    pub(crate) motions: &'a [MotionSettings],
    pub(crate) places: FilePlace<'a>,
    pub(crate) limits: &'a MotionLimits,
    /// The folder in which files that a motion names are found.
    pub(crate) folder: ScenarioFolder<'a>,
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
    /// What moves keep that are planned in the run.
    pub(super) limits: MotionLimits,
}

impl Trajectory {
    /// Plans the motions of a scenario, from the start configuration on.
    ///
    /// # Errors
    /// Every finding of the first motion that is wrong.
    pub(crate) fn new(
        input: MotionInput<'_>,
        description: &RobotDescription,
        start: &RobotQ,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
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
            if trajectory.ends_open() && !matches!(settings, MotionSettings::Servo(_)) {
                trajectory.push(open(settings, place)?);
                continue;
            }
            let from = trajectory.end().clone();
            let mut planning = Planning { description, limits, folder, from: &from, place: places, warnings };
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

    /// When each motion begins, and how long it takes.
    pub fn times(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.starts_s.iter().zip(&self.motions).map(|(&starts_s, motion)| (starts_s, motion.duration_s))
    }

    /// When the last motion ends.
    pub fn duration_s(&self) -> f64 {
        match (self.starts_s.last(), self.motions.last()) {
            (Some(start_s), Some(motion)) => start_s + motion.duration_s,
            _ => 0.0,
        }
    }

    /// The planned positions at a time; `None` from the beginning of a servo on.
    pub(crate) fn planned_at(&self, time_s: f64) -> Option<RobotQ> {
        let Some((index, starts_s)) = self.under_way(time_s) else { return Some(self.start.clone()) };
        if self.motions[..=index].iter().any(|motion| !matches!(motion.course, Course::Planned(_))) {
            return None;
        }
        let Course::Planned(planned) = &self.motions[index].course else { return None };
        let mut q = self.start.clone();
        let (mut qd, mut qdd) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        planned.at(time_s - starts_s, SetpointMut { q: &mut q, qd: &mut qd, qdd: &mut qdd });
        Some(q)
    }

    /// The accelerations that are declared for the joints, infinity for none.
    pub(crate) fn declared_accelerations(&self) -> &[f64] {
        &self.limits.declared_acceleration
    }

    /// Whether a motion is computed in the run.
    pub(super) fn has_servo(&self) -> bool {
        self.motions.iter().any(|motion| matches!(motion.course, Course::Servo(_)))
    }

    /// Whether the end of the last motion is known only in the run.
    pub(crate) fn ends_open(&self) -> bool {
        matches!(self.motions.last(), Some(Motion { course: Course::Servo(_) | Course::Open(_), .. }))
    }

    /// The last end of a motion that is known.
    pub(super) fn end(&self) -> &RobotQ {
        let known = self.motions.iter().rev().find_map(|motion| match &motion.course {
            Course::Planned(planned) => Some(&planned.to),
            Course::Servo(_) | Course::Open(_) => None,
        });
        known.unwrap_or(&self.start)
    }

    /// The motion at `time_s` with the time of its start, also after its duration; `None` before the first.
    pub(super) fn under_way(&self, time_s: f64) -> Option<(usize, f64)> {
        let current = self.starts_s.partition_point(|&start_s| start_s <= time_s).checked_sub(1)?;
        Some((current, self.starts_s[current]))
    }
}

/// Plans the first of these motions, with those that it leads into; `planning.place` is the list of all motions, in which
/// the first has this index.
pub(super) fn plan(
    motions: &[MotionSettings],
    first: usize,
    planning: &mut Planning<'_>,
) -> Result<Vec<Motion>, Vec<Diagnostic>> {
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

/// A motion that is planned in the run: it starts where a servo has brought the arm.
fn open(settings: &MotionSettings, place: FilePlace<'_>) -> Result<Motion, Diagnostic> {
    let refused = |message: &str, help: &str| {
        place.mark(Diagnostic::error("scenario::after_servo", message).with_help(help.to_owned()))
    };
    let blends = match settings {
        MotionSettings::Line(line) => line.blend_m > 0.0,
        MotionSettings::Arc(arc) => arc.blend_m > 0.0,
        _ => false,
    };
    if blends {
        let message =
            "the motion starts where a servo_tcp ends and is planned alone, so it cannot blend into the next";
        return Err(refused(message, "leave `blend_m` out, or put the motions before the servo_tcp"));
    }
    let duration_s = settings.duration_s().ok_or_else(|| match settings {
        MotionSettings::Playback(_) | MotionSettings::TcpPath(_) => refused(
            "the motion starts where a servo_tcp ends, which only the run tells",
            "put it before the servo_tcp, or move the joints after the servo_tcp instead",
        ),
        _ => refused(
            "the motion starts where a servo_tcp ends, which only the run tells: its duration is not known",
            "give `duration_s`",
        ),
    })?;
    Ok(Motion { duration_s, course: Course::Open(Box::new(settings.clone())) })
}
