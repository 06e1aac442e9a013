//! Controllers: from state and reference to what the actuators do. One file each; a new one is
//! its file and one line in [`KNOWN`].

mod commands;
mod gravity_compensation;
mod kinematic;
mod passive;
mod pd;

pub use commands::{Commands, JointsView, Motor, Setpoint};

use crate::error::SimulationError;

/// Decides before each step what the actuators do in it.
///
/// A controller only fills [`Commands`]; the world applies them, and clips every force to the
/// joint's effort limit where the description gives one above zero.
pub trait Controller {
    /// The name under which [`controller`] finds it.
    fn name(&self) -> &'static str;

    /// Fills `commands`, which come cleared: no torque, no motor, dynamics on.
    fn command(&mut self, joints: &JointsView<'_>, reference: &Setpoint<'_>, commands: &mut Commands);
}

/// Gains of a joint servo, the same for every joint: N m/rad and N m s/rad for an angle, N/m and
/// N s/m for a shift.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gains {
    /// Torque per position error.
    pub stiffness: f64,
    /// Torque per velocity error.
    pub damping: f64,
}

impl Gains {
    fn check(self) -> Result<Self, SimulationError> {
        let refused = |gain, value: f64| SimulationError::Gain { gain, value };
        for (gain, value) in [("stiffness", self.stiffness), ("damping", self.damping)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(refused(gain, value));
            }
        }
        Ok(self)
    }
}

type Make = fn(Gains) -> Box<dyn Controller>;

/// Every controller by name.
const KNOWN: [(&str, Make); 4] = [
    (passive::NAME, |_| Box::new(passive::Passive)),
    (kinematic::NAME, |_| Box::new(kinematic::Kinematic)),
    (pd::NAME, |gains| Box::new(pd::Pd { gains })),
    (gravity_compensation::NAME, |gains| Box::new(gravity_compensation::GravityCompensation { gains })),
];

/// The names that [`controller`] knows.
pub fn controller_names() -> impl ExactSizeIterator<Item = &'static str> + Clone {
    KNOWN.iter().map(|(name, _)| *name)
}

/// The controller of this name; `passive` and `kinematic` ignore the gains.
///
/// # Errors
/// [`SimulationError::UnknownController`] and [`SimulationError::Gain`].
///
/// # Examples
/// ```
/// use congruent_simulation::{Gains, controller};
/// let pd = controller("pd", Gains { stiffness: 400.0, damping: 40.0 })?;
/// assert_eq!(pd.name(), "pd");
/// # Ok::<(), congruent_simulation::SimulationError>(())
/// ```
pub fn controller(kind: &str, gains: Gains) -> Result<Box<dyn Controller>, SimulationError> {
    let gains = gains.check()?;
    let found = KNOWN.iter().find(|(name, _)| *name == kind);
    found.map(|(_, make)| make(gains)).ok_or_else(|| SimulationError::UnknownController {
        name: kind.to_owned(),
        known: controller_names().collect(),
    })
}
