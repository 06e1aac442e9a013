//! Every controller by name; a new one is its file and a line in [`KNOWN`].

use super::{controller::Controller, gains::Gains, gravity_compensation, kinematic, passive, pd};
use crate::error::SimulationError;

type Make = fn(Gains) -> Box<dyn Controller>;

/// Every controller by name.
const KNOWN: [(&str, Make); 4] = [
    (passive::NAME, |_| Box::new(passive::Passive)),
    (kinematic::NAME, |_| Box::new(kinematic::Kinematic)),
    (pd::NAME, |gains| Box::new(pd::Pd { gains })),
    (gravity_compensation::NAME, |gains| Box::new(gravity_compensation::GravityCompensation { gains })),
];

/// The names of all controllers.
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
