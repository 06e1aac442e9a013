//! Playback: the robot is placed at the setpoint, without dynamics.

use super::{
    commands::Commands,
    controller::Controller,
    joints_view::{JointsView, Setpoint},
};

pub(super) const NAME: &str = "kinematic";

/// Places positions and velocities; no dynamics, no limits, no contacts.
#[derive(Clone)]
pub(super) struct Kinematic;

impl Controller for Kinematic {
    fn name(&self) -> &'static str {
        NAME
    }

    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, commands: &mut Commands) {
        commands.place();
    }
}
