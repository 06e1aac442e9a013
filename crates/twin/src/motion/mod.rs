//! What the arm is asked to do: motions one after another. Moves are planned when the scenario is
//! read, servos are computed in the run (`reference_generator.rs`). A new kind of motion is a file here and a line in
//! `KINDS`.

mod joint_move;
mod profile;
mod reference_generator;
mod tcp_move;
mod tcp_servo;

use congruent_description::{Diagnostic, Robot, RobotDescription, RobotQ};

pub use profile::{Profile, Progress};
pub use reference_generator::ReferenceGenerator;
pub use tcp_servo::{Method, ServoResult, TcpServo};

use crate::scenario::Section;

/// What a motion's parser may look at.
struct Context<'a> {
    description: &'a RobotDescription,
    robot: &'a Robot,
    /// Where the motion before it ends; before a motion that needs no start, the last place that is
    /// known.
    from: &'a RobotQ,
    warnings: &'a mut Vec<Diagnostic>,
}

/// How one kind of motion is made from its section; it is known by its keys.
struct Kind {
    keys: &'static [&'static str],
    /// Whether it is planned, from a start that must be known.
    is_planned: bool,
    parse: fn(Section<'_>, &mut Context<'_>) -> Result<Motion, Vec<Diagnostic>>,
}

/// Every kind of motion.
const KINDS: &[Kind] = &[
    Kind { keys: joint_move::KEYS, is_planned: true, parse: joint_move::parse },
    Kind { keys: tcp_move::KEYS, is_planned: true, parse: tcp_move::parse },
    Kind { keys: tcp_servo::KEYS, is_planned: false, parse: tcp_servo::parse },
];

/// One motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// How long it takes.
    pub duration_s: f64,
    /// Where it goes.
    pub course: Course,
}

/// Where a motion goes.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// From one configuration to another.
    Joints(JointMove),
    /// Closed over the measured positions, step by step.
    Servo(Box<TcpServo>),
}

/// A planned move; its vectors are configuration vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMove {
    /// Positions at its start, rad or m.
    pub from: RobotQ,
    /// Positions at its end, rad or m.
    pub to: RobotQ,
    /// Its course in between.
    pub profile: Profile,
}

impl JointMove {
    /// Writes positions and velocities where a share of the way is done.
    fn at(&self, progress: Progress, q: &mut RobotQ, qd: &mut [f64]) {
        for ((q, qd), (from, to)) in q.iter_mut().zip(qd).zip(self.from.iter().zip(&self.to)) {
            *q = from + (to - from) * progress.share;
            *qd = (to - from) * progress.share_per_s;
        }
    }
}

/// All motions of a scenario; the arm holds before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    start: RobotQ,
    motions: Vec<Motion>,
    /// Start time of each motion.
    starts_s: Vec<f64>,
}

impl Trajectory {
    /// Reads the `[[motion]]` sections of a scenario, from the start configuration on.
    ///
    /// # Errors
    /// Every finding of the first section that is wrong.
    pub fn parse(
        sections: Vec<Section<'_>>,
        description: &RobotDescription,
        start: &RobotQ,
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut trajectory = Self { start: start.clone(), motions: Vec::new(), starts_s: Vec::new() };
        for section in sections {
            let starts_s = trajectory.duration_s();
            let mut context =
                Context { description, robot: &description.robot, from: trajectory.end(), warnings };
            let kind = KINDS.iter().find(|kind| kind.keys.iter().any(|key| section.has(key)));
            let kind = kind.ok_or_else(|| vec![unknown_kind(&section)])?;
            if kind.is_planned && trajectory.ends_open() {
                return Err(after_servo(&section).into());
            }
            let motion = (kind.parse)(section, &mut context)?;
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
    fn has_servo(&self) -> bool {
        self.motions.iter().any(|motion| matches!(motion.course, Course::Servo(_)))
    }

    /// Whether only the run can tell where the last motion ends.
    fn ends_open(&self) -> bool {
        matches!(self.motions.last(), Some(Motion { course: Course::Servo(_), .. }))
    }

    /// Where the last motion ends whose end is known.
    fn end(&self) -> &RobotQ {
        let known = self.motions.iter().rev().find_map(|motion| match &motion.course {
            Course::Joints(joints) => Some(&joints.to),
            Course::Servo(_) => None,
        });
        known.unwrap_or(&self.start)
    }

    /// The motion at `time_s`, which is over where its duration is, with the time of its start; `None`
    /// before the first.
    fn under_way(&self, time_s: f64) -> Option<(usize, f64)> {
        let current = self.starts_s.partition_point(|&start_s| start_s <= time_s).checked_sub(1)?;
        Some((current, self.starts_s[current]))
    }
}

fn after_servo(section: &Section<'_>) -> Diagnostic {
    Diagnostic::error(
        "scenario::after_servo",
        "the motion starts where a servo_tcp ends, which only the run tells",
    )
    .with_help("put it before the servo_tcp, or let another servo_tcp follow")
    .at(section.span())
}

fn unknown_kind(section: &Section<'_>) -> Diagnostic {
    let known: Vec<&str> = KINDS.iter().flat_map(|kind| kind.keys.iter().copied()).collect();
    Diagnostic::error("scenario::unknown_motion", "the motion does not say what moves")
        .with_help(format!("give one of {}", known.join(", ")))
        .at(section.span())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 1 to 3 in 2 s, then to -1 in 1 s.
    fn trajectory() -> Trajectory {
        let motion = |from, to, duration_s| Motion {
            duration_s,
            course: Course::Joints(JointMove { from: vec![from], to: vec![to], profile: Profile::Linear }),
        };
        Trajectory {
            start: vec![1.0],
            motions: vec![motion(1.0, 3.0, 2.0), motion(3.0, -1.0, 1.0)],
            starts_s: vec![0.0, 2.0],
        }
    }

    #[track_caller]
    fn at(trajectory: &Trajectory, time_s: f64, q: f64, qd: f64) {
        let mut reference_generator = ReferenceGenerator::with(trajectory, None);
        reference_generator.advance(time_s, &[f64::NAN]).unwrap();
        assert_eq!(
            (reference_generator.q(), reference_generator.qd()),
            (&[q][..], &[qd][..]),
            "at {time_s} s"
        );
    }

    #[test]
    fn one_motion_after_another() {
        let trajectory = trajectory();
        at(&trajectory, 0.0, 1.0, 0.0);
        at(&trajectory, 1.5, 2.5, 1.0);
        // Where one ends the next begins: the position is the same, and both rest there.
        at(&trajectory, 2.0, 3.0, 0.0);
        at(&trajectory, 2.5, 1.0, -4.0);
        at(&trajectory, 3.0, -1.0, 0.0);
        at(&trajectory, 100.0, -1.0, 0.0);
        assert_eq!((trajectory.duration_s(), trajectory.end()), (3.0, [-1.0].as_slice()));
    }

    #[test]
    fn without_motions_it_holds_the_start() {
        let still = Trajectory { start: vec![1.0], motions: Vec::new(), starts_s: Vec::new() };
        at(&still, 7.0, 1.0, 0.0);
        assert_eq!((still.duration_s(), still.end()), (0.0, [1.0].as_slice()));
    }
}
