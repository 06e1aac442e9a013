//! No actuation: the robot swings.

use super::{
    commands::Commands,
    controller::Controller,
    joints_view::{JointsView, Setpoint},
};

pub(super) const NAME: &str = "passive";

/// Exerts nothing.
#[derive(Clone)]
pub(super) struct Passive;

impl Controller for Passive {
    fn name(&self) -> &'static str {
        NAME
    }

    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, _: &mut Commands) {}
}
