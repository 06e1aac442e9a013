//! A trajectory under way: what it asks of the joints, step after step.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::KinematicsError;

use super::{
    course::Course,
    tcp_servo::{ServoController, ServoResult, StepInterval},
    trajectory::Trajectory,
};

/// The reference of a run. Moves are planned and only looked up; servos follow where the robot
/// is measured, so that the loop is closed at every step.
#[derive(Debug)]
pub struct ReferenceGenerator<'a> {
    trajectory: &'a Trajectory,
    /// What servos need; `None` where there are none.
    servo_controller: Option<ServoController<'a>>,
    /// The motion of the last step.
    current: Option<usize>,
    /// The time that the reference is for.
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    servo_results: Vec<ServoResult>,
}

impl<'a> ReferenceGenerator<'a> {
    /// At the start of a trajectory.
    ///
    /// # Errors
    /// [`KinematicsError::NoJoint`] where a servo has no joint to move; reading the scenario has
    /// refused that before.
    pub fn new(
        trajectory: &'a Trajectory,
        description: &'a RobotDescription,
    ) -> Result<Self, KinematicsError> {
        let servo_controller =
            trajectory.has_servo().then(|| ServoController::new(description)).transpose()?;
        Ok(Self::with(trajectory, servo_controller))
    }

    pub(super) fn with(trajectory: &'a Trajectory, servo_controller: Option<ServoController<'a>>) -> Self {
        let q = trajectory.start.clone();
        let qd = vec![0.0; q.len()];
        Self { trajectory, servo_controller, current: None, time_s: 0.0, q, qd, servo_results: Vec::new() }
    }

    /// The desired positions, rad or m, one entry for each movable joint.
    pub fn q(&self) -> &RobotQ {
        &self.q
    }

    /// The desired velocities, rad/s or m/s, likewise.
    pub fn qd(&self) -> &[f64] {
        &self.qd
    }

    /// Goes on to the reference for `time_s`, later than the last; `measured_q` is where the robot is
    /// now, one step before.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `measured_q` is no configuration of the robot.
    pub fn advance(&mut self, time_s: f64, measured_q: &RobotQ) -> Result<(), KinematicsError> {
        let before_s = std::mem::replace(&mut self.time_s, time_s);
        let Some((index, starts_s)) = self.trajectory.under_way(time_s) else { return Ok(()) };
        if self.current != Some(index) {
            self.leave(measured_q)?;
            self.current = Some(index);
        }
        let motion = &self.trajectory.motions[index];
        match &motion.course {
            Course::Joints(joints) => {
                let progress = joints.profile.at(time_s - starts_s, motion.duration_s);
                joints.at(progress, &mut self.q, &mut self.qd);
            }
            Course::Servo(servo) => {
                // The part of this step that lies within the motion.
                let [from_s, to_s] =
                    [before_s, time_s].map(|time_s| (time_s - starts_s).clamp(0.0, motion.duration_s));
                let interval = StepInterval { step_s: time_s - before_s, moved_s: to_s - from_s };
                needed(&mut self.servo_controller).lead(
                    servo,
                    measured_q,
                    interval,
                    (&mut self.q, &mut self.qd),
                )?;
            }
        }
        Ok(())
    }

    /// The results of the servos, of the one under way for where the robot is now, unless physics
    /// has lost it.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when `measured_q` is no configuration of the robot.
    pub fn finish(&mut self, measured_q: &RobotQ) -> Result<Vec<ServoResult>, KinematicsError> {
        if measured_q.iter().all(|q| q.is_finite()) {
            self.leave(measured_q)?;
        }
        Ok(std::mem::take(&mut self.servo_results))
    }

    /// Looks back on the motion that ends: the next begins at the end of a move, and where a servo has
    /// come to.
    fn leave(&mut self, measured_q: &RobotQ) -> Result<(), KinematicsError> {
        let Some(index) = self.current else { return Ok(()) };
        match &self.trajectory.motions[index].course {
            Course::Joints(joints) => self.q.copy_from_slice(&joints.to),
            Course::Servo(servo) => {
                self.servo_results.push(needed(&mut self.servo_controller).look_back(
                    servo,
                    index + 1,
                    measured_q,
                    &self.q,
                )?);
            }
        }
        Ok(())
    }
}

fn needed<'d, 'a>(servo_controller: &'d mut Option<ServoController<'a>>) -> &'d mut ServoController<'a> {
    servo_controller.as_mut().expect("a trajectory with a servo has a servo controller")
}
