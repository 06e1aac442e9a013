//! One motion as data: its duration, and a planned move or a servo.

use std::sync::Arc;

use congruent_description::RobotQ;
use congruent_kinematics::IkTarget;

use super::{
    joints::{JointSpline, SplineValues},
    timing::Pace,
};
use crate::scenario::{MotionSettings, ServoMethod};

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
    /// Planned before the run.
    Planned(PlannedMove),
    /// Planned in the run, when the motion begins: a servo came before.
    Open(Box<MotionSettings>),
    /// A servo: computed at every step from the measured positions.
    Servo(Box<TcpServo>),
}

/// A planned move of all joints.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedMove {
    /// The positions on its way.
    pub way: Way,
    /// Positions at its end.
    pub to: RobotQ,
    /// Its progress along the way.
    pub pace: Pace,
    /// The time of the pace at which the move begins: motions that blend into each other have one pace.
    pub begins_s: f64,
}

/// Positions of all joints by the share of the way.
#[derive(Debug, Clone, PartialEq)]
pub enum Way {
    /// All joints proceed together, from here to the end of the move.
    Straight(RobotQ),
    /// A spline over the share of the way.
    Spline(Arc<JointSpline>),
}

/// The setpoint of all joints, to be written.
pub(super) struct SetpointMut<'a> {
    pub(super) q: &'a mut [f64],
    pub(super) qd: &'a mut [f64],
    pub(super) qdd: &'a mut [f64],
}

impl PlannedMove {
    /// Writes the setpoint of a time after the begin of the move.
    pub(super) fn at(&self, elapsed_s: f64, setpoint: SetpointMut<'_>) {
        let progress = self.pace.at(self.begins_s + elapsed_s);
        let SetpointMut { q, qd, qdd } = setpoint;
        match &self.way {
            Way::Straight(from) => {
                for (joint, (from, to)) in from.iter().zip(&self.to).enumerate() {
                    q[joint] = from + (to - from) * progress.share;
                    qd[joint] = (to - from) * progress.share_per_s;
                    qdd[joint] = (to - from) * progress.share_per_s2;
                }
            }
            Way::Spline(spline) => {
                spline.at(progress.share, SplineValues { q, first: qd, second: qdd });
                for (qd, qdd) in qd.iter_mut().zip(qdd) {
                    *qdd = *qdd * progress.share_per_s * progress.share_per_s + *qd * progress.share_per_s2;
                    *qd *= progress.share_per_s;
                }
            }
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
