//! Playback: the robot is where the reference says, whatever it weighs.

use super::{Commands, Controller, JointsView, Setpoint};

pub(super) const NAME: &str = "kinematic";

/// Places positions and velocities; no dynamics, no limits, no contacts.
pub(super) struct Kinematic;

impl Controller for Kinematic {
    fn name(&self) -> &'static str {
        NAME
    }

    fn command(&mut self, _: &JointsView<'_>, _: &Setpoint<'_>, commands: &mut Commands) {
        commands.place();
    }
}
