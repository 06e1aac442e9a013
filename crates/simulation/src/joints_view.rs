//! The input of a controller: the joints at the beginning of the step, and the setpoint for its end.

use congruent_description::RobotQ;
use nalgebra::Vector3;

use crate::engine::Engine;

/// The desired state at the end of the step, one entry for each movable joint, mimic joints
/// included, in the order of `Robot::movable_joints`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setpoint<'a> {
    /// Positions, rad or m.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s.
    pub qd: &'a [f64],
    /// Accelerations, rad/s^2 or m/s^2.
    pub qdd: &'a [f64],
}

/// The state that the sensors of the joints give: one entry for each movable joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredState<'a> {
    /// Positions, rad or m.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s.
    pub qd: &'a [f64],
}

/// The joints at the beginning of the step, as the controller knows them.
pub struct JointsView<'a> {
    pub(crate) q: &'a RobotQ,
    pub(crate) qd: &'a [f64],
    pub(crate) time_s: f64,
    pub(crate) engine: &'a Engine,
}

impl JointsView<'_> {
    /// Positions, rad or m.
    pub fn q(&self) -> &RobotQ {
        self.q
    }

    /// Velocities, rad/s or m/s.
    pub fn qd(&self) -> &[f64] {
        self.qd
    }

    /// Simulated time at the beginning of the step, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Length of the step, s.
    pub fn step_s(&self) -> f64 {
        self.engine.step_s()
    }

    /// Acceleration of free fall, m/s^2.
    pub fn gravity_in_world(&self) -> Vector3<f64> {
        self.engine.gravity_in_world()
    }

    /// Whether the joint mimics another and has no actuator of its own.
    pub fn is_mimic(&self, coordinate: usize) -> bool {
        self.engine.is_mimic(coordinate)
    }

    /// Adds to `torque` the efforts that hold the robot against gravity, N m or N.
    ///
    /// # Panics
    /// If `torque` does not hold one entry for each movable joint.
    pub fn add_gravity_torque(&self, torque: &mut [f64]) {
        self.engine.add_gravity_torque(torque);
    }
}
