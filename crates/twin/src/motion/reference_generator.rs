//! The setpoints of a trajectory, step after step.

use congruent_description::{RobotDescription, RobotQ};
use congruent_kinematics::KinematicsError;

use super::{
    course::Course,
    tcp_servo::{ServoController, ServoResult, StepInterval},
    trajectory::Trajectory,
};

/// The setpoints of a run. Planned moves are evaluated at the time; servos are computed from the measured
/// positions at every step.
#[derive(Debug, Clone)]
pub struct ReferenceGenerator<'a> {
    trajectory: &'a Trajectory,
    /// The controller of the servos; `None` if there are none.
    servo_controller: Option<ServoController<'a>>,
    /// The motion of the last step.
    current: Option<usize>,
    /// The time of the setpoint.
    time_s: f64,
    q: RobotQ,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    servo_results: Vec<ServoResult>,
}

impl<'a> ReferenceGenerator<'a> {
    /// At the start of a trajectory.
    ///
    /// # Errors
    /// [`KinematicsError::NoJoint`] if a servo has no joint to move; `RunSetup` refuses such scenarios.
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
        let [qd, qdd] = [vec![0.0; q.len()], vec![0.0; q.len()]];
        let (current, servo_results) = (None, Vec::new());
        Self { trajectory, servo_controller, current, time_s: 0.0, q, qd, qdd, servo_results }
    }

    /// The desired positions, rad or m, one entry for each movable joint.
    pub fn q(&self) -> &RobotQ {
        &self.q
    }

    /// The desired velocities, rad/s or m/s, likewise.
    pub fn qd(&self) -> &[f64] {
        &self.qd
    }

    /// The desired accelerations, rad/s^2 or m/s^2, likewise; zero in a servo.
    pub fn qdd(&self) -> &[f64] {
        &self.qdd
    }

    /// Computes the setpoint for `time_s`, which is later than the last; `measured_q` are the positions one step
    /// before.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] if `measured_q` is not a configuration of the robot.
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
                joints.at(progress, &mut self.q, &mut self.qd, &mut self.qdd);
            }
            Course::Servo(servo) => {
                // The part of this step that lies within the motion.
                let [from_s, to_s] =
                    [before_s, time_s].map(|time_s| (time_s - starts_s).clamp(0.0, motion.duration_s));
                self.qdd.fill(0.0);
                let interval = StepInterval { step_s: time_s - before_s, moved_s: to_s - from_s };
                needed(&mut self.servo_controller).advance(
                    servo,
                    measured_q,
                    interval,
                    (&mut self.q, &mut self.qd),
                )?;
            }
        }
        Ok(())
    }

    /// The results of the servos; of the current one at the present positions, unless these are not finite.
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] if `measured_q` is not a configuration of the robot.
    pub fn finish(&mut self, measured_q: &RobotQ) -> Result<Vec<ServoResult>, KinematicsError> {
        if measured_q.iter().all(|q| q.is_finite()) {
            self.leave(measured_q)?;
        }
        Ok(std::mem::take(&mut self.servo_results))
    }

    /// Closes the motion that ends: the next begins at the end of a move, or at the positions that a servo has
    /// reached.
    fn leave(&mut self, measured_q: &RobotQ) -> Result<(), KinematicsError> {
        let Some(index) = self.current else { return Ok(()) };
        match &self.trajectory.motions[index].course {
            Course::Joints(joints) => self.q.copy_from_slice(&joints.to),
            Course::Servo(servo) => {
                self.servo_results.push(needed(&mut self.servo_controller).result(
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
