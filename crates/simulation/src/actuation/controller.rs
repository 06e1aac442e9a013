//! The trait of controllers.

use super::{
    commands::Commands,
    joints_view::{JointsView, Setpoint},
};

/// Decides before each step which commands the actuators get.
///
/// A controller only fills [`Commands`]; the world applies them, and clips every force to the
/// joint's effort limit if the description gives one above zero.
pub trait Controller: CloneController {
    /// The name under which [`controller`](crate::controller) finds it.
    fn name(&self) -> &'static str;

    /// Fills `commands`, which come cleared: no torque, no motor, dynamics on.
    fn command(&mut self, joints: &JointsView<'_>, setpoint: &Setpoint<'_>, commands: &mut Commands);
}

/// A copy of a controller with its state, for snapshots: every [`Controller`] that is `Clone` has it.
pub trait CloneController {
    /// The copy.
    fn boxed_clone(&self) -> Box<dyn Controller>;
}

impl<C: Controller + Clone + 'static> CloneController for C {
    fn boxed_clone(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}
