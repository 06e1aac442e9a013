//! Servos of the joints: stiffness, damping and integral, with the gravity torque of the declared robot or without.

use congruent_monitors::ActuatorLimits;
use congruent_simulation::{Commands, Gains, JointsView, Motor, Setpoint};

use super::model::DeclaredModel;
use crate::setup::RunSetup;

/// One servo for each joint; gains of zero exert nothing.
#[derive(Debug, Clone)]
pub(super) struct Servos<'a> {
    gains: Vec<Gains>,
    integrals: Option<Integrals>,
    /// `None` for servos that sag under gravity.
    gravity: Option<Box<DeclaredModel<'a>>>,
    torque: Vec<f64>,
}

/// The integral part of all servos.
#[derive(Debug, Clone)]
struct Integrals {
    /// Torque per integral of the position error.
    gains: Vec<f64>,
    /// Torques that the actuators exert now, N m or N.
    torques: Vec<f64>,
    /// Largest effort and speed of each actuator.
    limits: Vec<ActuatorLimits>,
}

impl<'a> Servos<'a> {
    pub(super) fn new(setup: &'a RunSetup) -> Self {
        let gains = setup.controller.gains.clone();
        Self { torque: vec![0.0; gains.len()], gains, integrals: None, gravity: None }
    }

    /// Servos on velocity alone.
    pub(super) fn on_velocity(mut self) -> Self {
        self.gains.iter_mut().for_each(|gains| gains.stiffness = 0.0);
        self
    }

    pub(super) fn with_integral(mut self, setup: &'a RunSetup) -> Self {
        let gains = setup.controller.integral.clone();
        let torques = vec![0.0; gains.len()];
        self.integrals = Some(Integrals { gains, torques, limits: setup.actuator_limits() });
        self
    }

    pub(super) fn with_gravity(mut self, setup: &'a RunSetup) -> Self {
        self.gravity = Some(Box::new(DeclaredModel::new(setup)));
        self
    }

    /// Integrals and gravity: torques that are constant over the period. The setpoint is that of its end.
    fn update(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, period_s: f64) {
        self.torque.fill(0.0);
        if let Some(gravity) = &mut self.gravity {
            gravity.add_gravity(joints.time_s(), joints.q(), &mut self.torque);
        }
        let Some(integrals) = &mut self.integrals else { return };
        for (joint, torque) in self.torque.iter_mut().enumerate() {
            let present = StateError::now(joint, joints, setpoint);
            // With gravity, since the limit of the actuator is for the sum.
            let servo = *torque + present.effort(self.gains[joint]);
            *torque += integrals.advance(joint, servo, joints.qd()[joint], present.position * period_s);
        }
    }

    /// Servos that are continuous in time.
    pub(super) fn command(
        &mut self,
        joints: &JointsView<'_>,
        setpoint: &Setpoint<'_>,
        commands: &mut Commands,
    ) {
        self.update(joints, setpoint, joints.step_s());
        commands.torque_mut().copy_from_slice(&self.torque);
        // Stiffness and damping go to the engine as motors, integrated implicitly: computed here as torques they
        // would be unstable at high gains.
        for (joint, &gains) in self.gains.iter().enumerate() {
            commands.drive(joint, Motor { gains, q: setpoint.q[joint], qd: setpoint.qd[joint] });
        }
    }

    /// The efforts of the servos at this instant, for a controller that computes them once in a period.
    pub(super) fn efforts_into(
        &mut self,
        joints: &JointsView<'_>,
        setpoint: &Setpoint<'_>,
        period_s: f64,
        efforts: &mut [f64],
    ) {
        self.update(joints, setpoint, period_s);
        for (joint, effort) in efforts.iter_mut().enumerate() {
            // A digital controller has no motors: its whole effort is a torque of the last reading, with the limits
            // of stability that this has.
            let servo = StateError::now(joint, joints, setpoint).effort(self.gains[joint]);
            *effort = self.torque[joint] + servo;
        }
    }
}

impl Integrals {
    /// Adds `change`, an error times its duration, and returns the torque. While the actuator is at a limit, of effort or
    /// of speed, it does not go further in the same direction, and by itself it never asks for more than the largest
    /// effort (anti-windup by conditional integration; Astrom & Hagglund, *PID Controllers* (1995), sec. 3.5).
    fn advance(&mut self, joint: usize, servo: f64, qd: f64, change: f64) -> f64 {
        let (limit, torque) = (self.limits[joint], &mut self.torques[joint]);
        let effort = servo + *torque;
        // Only growth is stopped: an error of the other sign has to unwind the integral at once.
        let is_at_effort = effort.abs() >= limit.effort && effort * change >= 0.0;
        let is_at_speed = qd.abs() >= limit.speed && qd * change >= 0.0;
        if !is_at_effort && !is_at_speed {
            *torque = (*torque + self.gains[joint] * change).clamp(-limit.effort, limit.effort);
        }
        *torque
    }
}

/// Setpoint less measured state of one joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct StateError {
    pub(super) position: f64,
    pub(super) velocity: f64,
}

impl StateError {
    /// At the beginning of the step: the setpoint, which is that of its end, is taken back by the step.
    pub(super) fn now(joint: usize, joints: &JointsView<'_>, setpoint: &Setpoint<'_>) -> Self {
        let (step_s, qdd) = (joints.step_s(), setpoint.qdd[joint]);
        // Constant acceleration within the step.
        let qd = setpoint.qd[joint] - step_s * qdd;
        let q = setpoint.q[joint] - step_s * (qd + step_s * qdd / 2.0);
        Self { position: q - joints.q()[joint], velocity: qd - joints.qd()[joint] }
    }

    fn effort(self, gains: Gains) -> f64 {
        gains.stiffness * self.position + gains.damping * self.velocity
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_integral_stops_at_the_limit_and_comes_back_at_once() {
        let limits = vec![ActuatorLimits { effort: 5.0, speed: 2.0 }];
        let mut integrals = Integrals { gains: vec![100.0], torques: vec![0.0], limits };
        let mut after =
            |servo, change, times| (0..times).fold(0.0, |_, _| integrals.advance(0, servo, 0.0, change));
        assert!((after(0.0, 0.01, 3) - 3.0).abs() < 1e-12);
        assert!((after(0.0, 0.01, 1000) - 5.0).abs() < 1e-12, "not beyond the limit");
        assert!((after(0.0, -0.01, 1) - 4.0).abs() < 1e-12, "back with the first error of the other sign");
        assert!((after(2.0, 0.01, 1000) - 4.0).abs() < 1e-12, "the actuator is at its limit");
        assert!((after(-9.0, 0.0001, 1) - 4.01).abs() < 1e-12, "the servo pulls it off the limit");
        let mut at_speed = |qd, change| integrals.advance(0, 0.0, qd, change);
        assert!((at_speed(2.0, 0.001) - 4.01).abs() < 1e-12, "faster is not possible");
        assert!((at_speed(2.0, -0.001) - 3.91).abs() < 1e-12 && (at_speed(1.9, 0.001) - 4.01).abs() < 1e-12);
    }
}
