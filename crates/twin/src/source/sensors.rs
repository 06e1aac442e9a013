//! The sensors of the joints: from the true state to the measured one.

use congruent_description::RobotQ;
use congruent_simulation::MeasuredState;

/// The sensors of all joints with their last reading. They are exact.
#[derive(Debug, Clone)]
pub(super) struct JointSensors {
    q: RobotQ,
    qd: Vec<f64>,
}

impl JointSensors {
    pub(super) fn new(dof: usize) -> Self {
        Self { q: RobotQ::zeros(dof), qd: vec![0.0; dof] }
    }

    /// Reads the true state.
    pub(super) fn read(&mut self, q: &RobotQ, qd: &[f64]) {
        self.q.copy_from_slice(q);
        self.qd.copy_from_slice(qd);
    }

    /// The last reading.
    pub(super) fn measured(&self) -> MeasuredState<'_> {
        MeasuredState { q: &self.q, qd: &self.qd }
    }
}
