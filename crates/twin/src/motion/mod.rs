//! What the arm is asked to do: motions one after another, in joint space. A new kind of motion is
//! a file here and a line in `KINDS`.

mod joint_move;
mod profile;
mod tcp_move;

use congruent_description::{Diagnostic, Robot, RobotDescription};

pub use profile::{Profile, Progress};

use crate::scenario::Section;

/// What a motion's parser may look at.
struct Context<'a> {
    description: &'a RobotDescription,
    robot: &'a Robot,
    /// Where the motion before it ends.
    from: &'a [f64],
    warnings: &'a mut Vec<Diagnostic>,
}

/// How one kind of motion is made from its section; it is known by its keys.
struct Kind {
    keys: &'static [&'static str],
    parse: fn(Section<'_>, &mut Context<'_>) -> Result<Motion, Vec<Diagnostic>>,
}

/// Every kind of motion.
const KINDS: &[Kind] = &[
    Kind { keys: joint_move::KEYS, parse: joint_move::parse },
    Kind { keys: tcp_move::KEYS, parse: tcp_move::parse },
];

/// One motion in joint space; all vectors are configuration vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Positions at its start, rad or m.
    pub from: Vec<f64>,
    /// Positions at its end, rad or m.
    pub to: Vec<f64>,
    /// How long it takes.
    pub duration_s: f64,
    /// Its course in between.
    pub profile: Profile,
}

/// All motions of a scenario; the arm holds before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    start: Vec<f64>,
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
        start: &[f64],
        warnings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut trajectory = Self { start: start.to_vec(), motions: Vec::new(), starts_s: Vec::new() };
        for section in sections {
            let starts_s = trajectory.duration_s();
            let mut context =
                Context { description, robot: &description.robot, from: trajectory.end(), warnings };
            let kind = KINDS.iter().find(|kind| kind.keys.iter().any(|key| section.has(key)));
            let kind = kind.ok_or_else(|| vec![unknown_kind(&section)])?;
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

    /// Where the last motion ends.
    fn end(&self) -> &[f64] {
        self.motions.last().map_or(&self.start, |motion| &motion.to)
    }

    /// Writes the desired positions and velocities at `time_s`.
    pub fn reference_into(&self, time_s: f64, q: &mut [f64], qd: &mut [f64]) {
        let current = self.starts_s.partition_point(|&start_s| start_s <= time_s);
        let Some(current) = current.checked_sub(1) else {
            q.copy_from_slice(&self.start);
            qd.fill(0.0);
            return;
        };
        let motion = &self.motions[current];
        let progress = motion.profile.at(time_s - self.starts_s[current], motion.duration_s);
        for ((q, qd), (from, to)) in q.iter_mut().zip(qd).zip(motion.from.iter().zip(&motion.to)) {
            *q = from + (to - from) * progress.share;
            *qd = (to - from) * progress.share_per_s;
        }
    }
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
            from: vec![from],
            to: vec![to],
            duration_s,
            profile: Profile::Linear,
        };
        Trajectory {
            start: vec![1.0],
            motions: vec![motion(1.0, 3.0, 2.0), motion(3.0, -1.0, 1.0)],
            starts_s: vec![0.0, 2.0],
        }
    }

    #[track_caller]
    fn at(trajectory: &Trajectory, time_s: f64, q: f64, qd: f64) {
        let (mut found_q, mut found_qd) = ([f64::NAN], [f64::NAN]);
        trajectory.reference_into(time_s, &mut found_q, &mut found_qd);
        assert_eq!((found_q, found_qd), ([q], [qd]), "at {time_s} s");
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
