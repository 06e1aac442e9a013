//! No actuation: the robot swings.

use super::{
    commands::Commands,
    controller::Controller,
    joints_view::{JointsView, Setpoint},
};

/// Exerts nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Passive;

impl Controller for Passive {
    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, _: &mut Commands) {}
}
