//! A servo at every joint: stiffness on the position error, damping on the velocity error.
//! Without gravity compensation, so it sags by gravity torque / stiffness.

use super::{
    commands::Commands,
    controller::Controller,
    gains::Gains,
    joints_view::{JointsView, Setpoint, drive_all},
};

pub(super) const NAME: &str = "pd";

/// Servos; mimic joints follow their masters through the coupling.
#[derive(Clone)]
pub(super) struct Pd {
    pub(super) gains: Gains,
}

impl Controller for Pd {
    fn name(&self) -> &'static str {
        NAME
    }

    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        drive_all(self.gains, joints, setpoint, commands);
    }
}
