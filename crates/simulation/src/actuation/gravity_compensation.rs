//! The torque that holds the robot against gravity, at every joint, mimic joints included; with
//! gains, servos in addition.

use super::{
    commands::Commands,
    controller::Controller,
    gains::Gains,
    joints_view::{JointsView, Setpoint, drive_all},
};

pub(super) const NAME: &str = "gravity_compensation";

/// Gravity torque of the present configuration, and servos if the gains are not zero.
#[derive(Clone)]
pub(super) struct GravityCompensation {
    pub(super) gains: Gains,
}

impl Controller for GravityCompensation {
    fn name(&self) -> &'static str {
        NAME
    }

    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands) {
        joints.add_gravity_torque(commands.torque_mut());
        drive_all(self.gains, joints, setpoint, commands);
    }
}
