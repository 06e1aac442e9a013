//! One motion as data: its duration, and a planned move or a servo.

use std::sync::Arc;

use congruent_description::RobotQ;
use congruent_kinematics::IkTarget;
use congruent_scenario::{MotionSettings, ServoMethod};

use super::{
    spline::{JointSpline, SplineValues},
    timing::TimeScaling,
};

/// One motion of a scenario, ready to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Duration of the motion; of a servo, as the scenario gives it.
    pub duration_s: f64,
    /// The planned move, or the servo.
    pub motion_plan: MotionPlan,
}

/// The kind of a motion with its data.
#[derive(Debug, Clone, PartialEq)]
pub enum MotionPlan {
    /// A move that is planned before the run.
    Planned(PlannedMove),
    /// A move that is planned during the run, when it begins: it follows a servo, whose end is known only then.
    Open(Box<MotionSettings>),
    /// A servo: computed at every step from the measured positions.
    Servo(Box<TcpServo>),
}

/// A planned move of all joints.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedMove {
    /// The path of the joints, without time.
    pub joint_path: JointSpacePath,
    /// Joint positions at the end of the move.
    pub to: RobotQ,
    /// The time scaling of the path.
    pub time_scaling: TimeScaling,
    /// Time within the time scaling at which the move begins: motions that blend into each other share one.
    pub begins_s: f64,
}

/// Path of all joints: their positions over the share of the path, from 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub enum JointSpacePath {
    /// A straight line in joint space, from these positions to the end of the move.
    Straight(RobotQ),
    /// A spline over the share of the path.
    Spline(Arc<JointSpline>),
}

/// The setpoint of all joints, to be written: positions, velocities and accelerations in SI units.
pub(super) struct SetpointMut<'a> {
    pub(super) q: &'a mut RobotQ,
    pub(super) qd: &'a mut [f64],
    pub(super) qdd: &'a mut [f64],
}

impl PlannedMove {
    /// Writes the setpoint at a time after the beginning of the move.
    pub(super) fn at(&self, elapsed_s: f64, setpoint: SetpointMut<'_>) {
        let progress = self.time_scaling.at(self.begins_s + elapsed_s);
        let SetpointMut { q, qd, qdd } = setpoint;
        match &self.joint_path {
            JointSpacePath::Straight(from) => {
                for (joint, (from, to)) in from.iter().zip(&self.to).enumerate() {
                    q[joint] = from + (to - from) * progress.share;
                    qd[joint] = (to - from) * progress.share_per_s;
                    qdd[joint] = (to - from) * progress.share_per_s2;
                }
            }
            JointSpacePath::Spline(spline) => {
                spline.at(progress.share, SplineValues { q, first: qd, second: qdd });
                // Chain rule with share s: qd = q' ds/dt, qdd = q'' (ds/dt)^2 + q' d2s/dt2 (Lynch & Park, ch. 9). qdd first:
                // until then qd holds q'.
                for (qd, qdd) in qd.iter_mut().zip(qdd) {
                    *qdd = *qdd * progress.share_per_s * progress.share_per_s + *qd * progress.share_per_s2;
                    *qd *= progress.share_per_s;
                }
            }
        }
    }
}

/// A motion towards a pose of the tool in closed loop: controlled from the measured positions instead of planned.
#[derive(Debug, Clone, PartialEq)]
pub struct TcpServo {
    /// Target of the tool centre point in the base frame of the arm.
    pub target: IkTarget,
    /// Method by which joint velocities are computed from the error.
    pub method: ServoMethod,
    /// Gain, 1/s: the error decays as `exp(-gain t)` if no limit of a joint is active.
    pub gain_per_s: f64,
}
