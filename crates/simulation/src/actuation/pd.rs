//! A servo at every joint: stiffness on the position error, damping on the velocity error.
//! Without gravity compensation, so it sags by gravity torque / stiffness.

use super::controller::Controller;
use crate::{
    commands::{Commands, Gains, Motor},
    joints_view::{JointsView, Setpoint},
};

/// Servos; mimic joints follow their masters through the coupling.
#[derive(Debug, Clone, PartialEq)]
pub struct Pd {
    /// One for each movable joint; those of mimic joints are of no effect.
    pub gains: Vec<Gains>,
}

impl Controller for Pd {
    fn command(&mut self, _: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        let targets = setpoint.q.iter().zip(setpoint.qd);
        for (coordinate, (&gains, (&q, &qd))) in self.gains.iter().zip(targets).enumerate() {
            commands.drive(coordinate, Motor { gains, q, qd });
        }
    }
}
