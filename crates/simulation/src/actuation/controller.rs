//! The trait of controllers.

use crate::{
    commands::Commands,
    joints_view::{JointsView, Setpoint},
};

/// Decides before each step which commands the actuators get.
///
/// A controller only fills [`Commands`]; the world applies them within the limits of effort and speed that the
/// description gives above zero.
pub trait Controller {
    /// Fills `commands`, which come cleared: no torque, no motor, dynamics on.
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands);
}
