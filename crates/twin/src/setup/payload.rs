//! What a link carries for a time, in addition to its own mass: known to the physics, to controllers and to checks.

use congruent_description::Inertia;
use congruent_simulation::CarriedBody;

/// A body that a link carries from one time to another.
#[derive(Debug, Clone, PartialEq)]
pub struct Payload {
    /// Its name in reports.
    pub name: String,
    /// The link that carries it, and its inertia in the frame of the link.
    pub carried: CarriedBody,
    /// The link takes it at this time.
    pub from_s: f64,
    /// The link leaves it at this time; infinity for never.
    pub until_s: f64,
}

impl Payload {
    /// Whether the link carries it at a time: from its beginning on, no longer at its end.
    pub fn is_carried_at(&self, time_s: f64) -> bool {
        (self.from_s..self.until_s).contains(&time_s)
    }

    /// Its inertia in the frame of the link.
    pub fn inertia_in_link(&self) -> &Inertia {
        &self.carried.inertia
    }
}
