//! One motion as data: its duration, and a planned move or a servo.

use congruent_description::RobotQ;
use congruent_kinematics::IkTarget;

use crate::scenario::{Profile, Progress, ServoMethod};

/// One motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Its duration.
    pub duration_s: f64,
    /// The planned move or the servo.
    pub course: Course,
}

/// The kind of a motion with its data.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// From one configuration to another.
    Joints(JointMove),
    /// A servo: computed at every step from the measured positions.
    Servo(Box<TcpServo>),
}

/// A planned move from one configuration to another.
#[derive(Debug, Clone, PartialEq)]
pub struct JointMove {
    /// Positions at its start.
    pub from: RobotQ,
    /// Positions at its end.
    pub to: RobotQ,
    /// The profile of its progress over time.
    pub profile: Profile,
}

impl JointMove {
    /// Writes positions, velocities and accelerations at a progress of the move.
    pub(super) fn at(&self, progress: Progress, q: &mut RobotQ, qd: &mut [f64], qdd: &mut [f64]) {
        for (joint, (from, to)) in self.from.iter().zip(&self.to).enumerate() {
            let way = to - from;
            q[joint] = from + way * progress.share;
            qd[joint] = way * progress.share_per_s;
            qdd[joint] = way * progress.share_per_s2;
        }
    }
}

/// A motion towards a pose of the tool that is controlled from the measured positions instead of planned.
#[derive(Debug, Clone, PartialEq)]
pub struct TcpServo {
    /// The target in the arm's base.
    pub target: IkTarget,
    /// Method by which joint velocities are computed from the error.
    pub method: ServoMethod,
    /// Gain: the error decays as `exp(-gain t)` if no limit of a joint is active.
    pub gain_per_s: f64,
}
