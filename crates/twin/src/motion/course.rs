//! One motion as data: its duration, and a planned move or a servo.

use congruent_description::RobotQ;
use congruent_kinematics::IkTarget;

use crate::scenario::{Profile, Progress, ServoMethod};

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

/// A planned move from one configuration to another.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMove {
    /// Positions at its start.
    pub from: RobotQ,
    /// Positions at its end.
    pub to: RobotQ,
    /// How it runs in between.
    pub profile: Profile,
}

impl JointMove {
    /// Writes positions and velocities after a share of the move is done.
    pub(super) fn at(&self, progress: Progress, q: &mut RobotQ, qd: &mut [f64]) {
        for ((q, qd), (from, to)) in q.iter_mut().zip(qd).zip(self.from.iter().zip(&self.to)) {
            *q = from + (to - from) * progress.share;
            *qd = (to - from) * progress.share_per_s;
        }
    }
}

/// One motion that is closed over the measured positions and not planned.
#[derive(Debug, Clone, PartialEq)]
pub struct TcpServo {
    /// The target in the arm's base.
    pub target: IkTarget,
    /// How joint speeds follow from the error.
    pub method: ServoMethod,
    /// How fast the error decays: as `exp(-gain t)` where nothing limits the joints.
    pub gain_per_s: f64,
}
