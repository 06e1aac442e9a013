//! What a link carries for a time, in addition to its own mass: known to the physics, to controllers and to checks.

use congruent_description::{Diagnostic, Inertia};
use congruent_simulation::CarriedBody;

use crate::scenario::{FilePlace, Scenario};

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

/// Heaviest body that is carried. Kind: numerics; the mass matrix of an arm with more loses its links to rounding.
pub(crate) const HEAVIEST_KG: f64 = 1e6;

/// The message about a body that is heavier.
pub(crate) fn too_heavy(mass_kg: f64) -> String {
    format!("a mass of {mass_kg:e} kg is above {HEAVIEST_KG:e} kg, the most that is carried")
}

/// Warns of what is taken when the run has ended.
pub(super) fn taken_too_late(scenario: &Scenario, place: FilePlace<'_>, run_s: f64) -> Vec<Diagnostic> {
    let payloads = scenario.payload.iter().map(|payload| (payload.from_s, &payload.name));
    let grasps = scenario.grasp.iter().map(|grasp| (grasp.from_s, &grasp.body));
    let late = |key: &'static str, index: usize, (from_s, name): (f64, &String)| {
        let place = place.key(key).item(index).key("from_s");
        (from_s >= run_s).then(|| {
            let message = format!("\"{name}\" is taken at {from_s} s, but the run ends at {run_s} s");
            let warning = Diagnostic::warning("scenario::taken_too_late", message);
            place.mark(
                warning.with_help("it is carried at no time: give an earlier `from_s`, or let the run go on"),
            )
        })
    };
    let payloads = payloads.enumerate().filter_map(|(index, taken)| late("payload", index, taken));
    payloads.chain(grasps.enumerate().filter_map(|(index, taken)| late("grasp", index, taken))).collect()
}
