//! The motions of a scenario, one after another. Moves are planned when the scenario is checked, servos are
//! computed in the run (`reference_generator.rs`).

use congruent_description::{Diagnostic, RobotDescription, RobotQ};

use super::{
    course::{Course, Motion},
    joint_move,
    planning::Planning,
    tcp_move, tcp_servo,
};
use crate::scenario::{FilePlace, MotionSettings};

/// All motions of a scenario; the arm holds before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    pub(super) start: RobotQ,
    pub(super) motions: Vec<Motion>,
    /// Start time of each motion.
    pub(super) starts_s: Vec<f64>,
}

impl Trajectory {
    /// Plans the motions of a scenario, from the start configuration on.
    ///
    /// # Errors
    /// Every finding of the first motion that is wrong.
    pub fn new(
        (motions, places): (&[MotionSettings], FilePlace<'_>),
        description: &RobotDescription,
        start: &RobotQ,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut trajectory = Self { start: start.clone(), motions: Vec::new(), starts_s: Vec::new() };
        for (index, settings) in motions.iter().enumerate() {
            let place = places.item(index);
            let starts_s = trajectory.duration_s();
            let is_planned = !matches!(settings, MotionSettings::Servo(_));
            if is_planned && trajectory.ends_open() {
                return Err(vec![place.mark(after_servo())]);
            }
            let mut planning = Planning { description, from: trajectory.end(), place, warnings };
            let motion = match settings {
                MotionSettings::Joints(settings) => joint_move::plan(settings, &mut planning)?,
                MotionSettings::Tcp(settings) => tcp_move::plan(settings, &planning)?,
                MotionSettings::Servo(settings) => tcp_servo::plan(settings, &planning)?,
            };
            trajectory.motions.push(motion);
            trajectory.starts_s.push(starts_s);
        }
        Ok(trajectory)
    }

    /// The motions, one after another.
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// When the last motion ends.
    pub fn duration_s(&self) -> f64 {
        match (self.starts_s.last(), self.motions.last()) {
            (Some(start_s), Some(motion)) => start_s + motion.duration_s,
            _ => 0.0,
        }
    }

    /// Whether a motion is computed in the run.
    pub(super) fn has_servo(&self) -> bool {
        self.motions.iter().any(|motion| matches!(motion.course, Course::Servo(_)))
    }

    /// Whether the end of the last motion is known only in the run.
    fn ends_open(&self) -> bool {
        matches!(self.motions.last(), Some(Motion { course: Course::Servo(_), .. }))
    }

    /// The last end of a motion that is known.
    pub(super) fn end(&self) -> &RobotQ {
        let known = self.motions.iter().rev().find_map(|motion| match &motion.course {
            Course::Joints(joints) => Some(&joints.to),
            Course::Servo(_) => None,
        });
        known.unwrap_or(&self.start)
    }

    /// The motion at `time_s` with the time of its start, also after its duration; `None` before the first.
    pub(super) fn under_way(&self, time_s: f64) -> Option<(usize, f64)> {
        let current = self.starts_s.partition_point(|&start_s| start_s <= time_s).checked_sub(1)?;
        Some((current, self.starts_s[current]))
    }
}

fn after_servo() -> Diagnostic {
    Diagnostic::error(
        "scenario::after_servo",
        "the motion starts where a servo_tcp ends, which only the run tells",
    )
    .with_help("put it before the servo_tcp, or let another servo_tcp follow")
}
