//! No actuation: the robot swings.

use super::controller::Controller;
use crate::{
    commands::Commands,
    joints_view::{JointsView, Setpoint},
};

/// Controller that exerts no effort: the joints move freely.
#[derive(Debug, Clone, Copy, Default)]
pub struct Passive;

impl Controller for Passive {
    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, _: &mut Commands) {}
}
