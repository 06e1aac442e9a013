//! Given torques.

use super::controller::Controller;
use crate::{
    commands::Commands,
    joints_view::{JointsView, Setpoint},
};

/// Exerts the same torques in every step, N m or N: one for each movable joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Torque(pub Vec<f64>);

impl Controller for Torque {
    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, commands: &mut Commands) {
        commands.torque_mut().copy_from_slice(&self.0);
    }
}
