//! The commands of a controller to the actuators.

/// Gains of a joint servo: N m/rad and N m s/rad for an angle, N/m and N s/m for a shift.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gains {
    /// Torque per position error.
    pub stiffness: f64,
    /// Torque per velocity error.
    pub damping: f64,
}

/// A servo that is integrated implicitly, stable at any gain: it exerts
/// `stiffness (q - q(t)) + damping (qd - qd(t))`, state and target at the end of the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Stiffness and damping of the servo.
    pub gains: Gains,
    /// Target position at the end of the step, rad or m.
    pub q: f64,
    /// Target velocity at the end of the step, rad/s or m/s.
    pub qd: f64,
}

/// Commands to the actuators for one step.
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

    /// Scales what each actuator exerts. The effort of a servo is linear in its gains.
    pub(crate) fn deliver(&mut self, shares: &[f64]) {
        for ((torque, motor), share) in self.torque.iter_mut().zip(&mut self.motors).zip(shares) {
            *torque *= share;
            *motor = motor.and_then(|mut motor| {
                motor.gains.stiffness *= share;
                motor.gains.damping *= share;
                // As in `drive`: without gains there is no servo.
                (*share > 0.0).then_some(motor)
            });
        }
    }

    /// Takes over other commands without an allocation.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.torque.copy_from_slice(&other.torque);
        self.motors.copy_from_slice(&other.motors);
        self.placed = other.placed;
    }

    /// Torques to exert, N m or N, constant over the step; one entry for each movable joint.
    pub fn torque_mut(&mut self) -> &mut [f64] {
        &mut self.torque
    }

    /// Drives a joint by a servo, in addition to its torque. Gains of zero have no effect, and none have those of a
    /// mimic joint, which has no actuator of its own.
    pub fn drive(&mut self, coordinate: usize, motor: Motor) {
        let drives = motor.gains.stiffness > 0.0 || motor.gains.damping > 0.0;
        self.motors[coordinate] = drives.then_some(motor);
    }

    /// Places the robot at the setpoint's state at the end of the step, without dynamics.
    pub fn place(&mut self) {
        self.placed = true;
    }
}
