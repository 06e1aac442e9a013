//! Playback: the robot is placed at the setpoint, without dynamics.

use super::controller::Controller;
use crate::{
    commands::Commands,
    joints_view::{JointsView, Setpoint},
};

/// Places positions and velocities; no dynamics, no limits, no contacts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Kinematic;

impl Controller for Kinematic {
    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, commands: &mut Commands) {
        commands.place();
    }
}
