//! What a controller sees and what it may command.

use congruent_description::RobotQ;
use nalgebra::Vector3;

use super::Gains;
use crate::engine::Engine;

/// The desired state at the end of the step, one entry for each movable joint, mimic joints
/// included, in the order of `Robot::movable_joints`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setpoint<'a> {
    /// Positions, rad or m.
    pub q: &'a RobotQ,
    /// Velocities, rad/s or m/s.
    pub qd: &'a [f64],
}

/// The joints at the beginning of the step.
pub struct JointsView<'a> {
    pub(crate) q: &'a [f64],
    pub(crate) qd: &'a [f64],
    pub(crate) engine: &'a Engine,
}

impl JointsView<'_> {
    /// Positions, rad or m.
    pub fn q(&self) -> &[f64] {
        self.q
    }

    /// Velocities, rad/s or m/s.
    pub fn qd(&self) -> &[f64] {
        self.qd
    }

    /// Length of the step, s.
    pub fn step_s(&self) -> f64 {
        self.engine.step_s()
    }

    /// Acceleration of free fall, m/s^2.
    pub fn gravity_in_world(&self) -> Vector3<f64> {
        self.engine.gravity_in_world()
    }

    /// Whether the joint follows another instead of an actuator of its own.
    pub fn is_mimic(&self, coordinate: usize) -> bool {
        self.engine.is_mimic(coordinate)
    }

    /// Adds to `torque` what holds the robot against gravity, N m or N.
    ///
    /// # Panics
    /// When `torque` does not hold one entry for each movable joint.
    pub fn add_gravity_torque(&self, torque: &mut [f64]) {
        self.engine.add_gravity_torque(torque);
    }
}

/// A servo that rapier integrates implicitly, stable at any gain: it exerts
/// `stiffness (q - q(t)) + damping (qd - qd(t))`, state and target at the end of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Its gains.
    pub gains: Gains,
    /// Target position at the end of the step, rad or m.
    pub q: f64,
    /// Target velocity at the end of the step, rad/s or m/s.
    pub qd: f64,
}

/// What the actuators do in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Commands {
    pub(crate) torque: Vec<f64>,
    pub(crate) motors: Vec<Option<Motor>>,
    pub(crate) placed: bool,
}

impl Commands {
    pub(crate) fn new(dof: usize) -> Self {
        Self { torque: vec![0.0; dof], motors: vec![None; dof], placed: false }
    }

    pub(crate) fn clear(&mut self) {
        self.torque.fill(0.0);
        self.motors.fill(None);
        self.placed = false;
    }

    /// Torques to exert, N m or N, constant over the step; one entry for each movable joint.
    pub fn torque_mut(&mut self) -> &mut [f64] {
        &mut self.torque
    }

    /// Drives a joint by a servo, on top of its torque. Gains of zero drive nothing.
    pub fn drive(&mut self, coordinate: usize, motor: Motor) {
        // rapier takes a motor without gains for an infinitely stiff one.
        let drives = motor.gains.stiffness > 0.0 || motor.gains.damping > 0.0;
        self.motors[coordinate] = drives.then_some(motor);
    }

    /// Puts the robot into the reference's state at the end of the step, without dynamics.
    pub fn place(&mut self) {
        self.placed = true;
    }
}

/// Drives every joint that has an actuator of its own towards the reference.
pub(crate) fn drive_all(
    gains: Gains,
    joints: &JointsView<'_>,
    reference: &Setpoint<'_>,
    commands: &mut Commands,
) {
    for (coordinate, (&q, &qd)) in reference.q.iter().zip(reference.qd).enumerate() {
        if !joints.is_mimic(coordinate) {
            commands.drive(coordinate, Motor { gains, q, qd });
        }
    }
}
