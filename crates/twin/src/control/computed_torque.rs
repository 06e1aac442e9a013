//! Computed torque: the torque by which the declared robot follows the setpoint, with feedback in accelerations.

use congruent_simulation::{Gains, JointsView, Setpoint};

use super::{model::DeclaredModel, servos::StateError};
use crate::setup::RunSetup;

/// `tau = M(q) (qdd_r + stiffness e + damping e') + c(q, qd) + resistances`, `e = q_r - q`, at the measured state.
///
/// With the right model the error of every joint decays as `e'' + damping e' + stiffness e = 0`. Source: Lynch & Park,
/// *Modern Robotics* (2017), eq. 11.35.
#[derive(Debug, Clone)]
pub(super) struct ComputedTorque<'a> {
    gains: Vec<Gains>,
    model: DeclaredModel<'a>,
    qdd: Vec<f64>,
}

impl<'a> ComputedTorque<'a> {
    pub(super) fn new(setup: &'a RunSetup) -> Self {
        let gains = setup.controller.gains.clone();
        Self { qdd: vec![0.0; gains.len()], gains, model: DeclaredModel::new(setup) }
    }

    pub(super) fn efforts_into(
        &mut self,
        joints: &JointsView<'_>,
        setpoint: &Setpoint<'_>,
        efforts: &mut [f64],
    ) {
        for (joint, (qdd, gains)) in self.qdd.iter_mut().zip(&self.gains).enumerate() {
            let error = StateError::now(joint, joints, setpoint);
            *qdd = setpoint.qdd[joint] + gains.stiffness * error.position + gains.damping * error.velocity;
        }
        efforts.fill(0.0);
        // Feedback is part of the acceleration, so M(q) scales it: each joint's error decays alike in every
        // configuration.
        self.model.add_inverse(joints, &mut self.qdd, efforts);
    }
}
