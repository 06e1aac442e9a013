//! Bodies that links carry for a time, in addition to their own masses: known to the physics, to controllers and to checks.

use congruent_description::{CarriedBody, Inertia};
use congruent_input::Diagnostic;
use congruent_scenario::{FilePlace, Scenario};

use crate::codes;

/// A body that a link carries from one time to another.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPayload {
    /// Name of the body in reports.
    pub name: String,
    /// The link that carries the body, and the inertia of the body in the frame of that link.
    pub carried: CarriedBody,
    /// Time at which the link takes the body.
    pub from_s: f64,
    /// Time at which the link releases the body; infinity for never.
    pub until_s: f64,
}

impl RunPayload {
    /// Whether the link carries the body at a time: `from_s` included, `until_s` excluded.
    pub fn is_carried_at(&self, time_s: f64) -> bool {
        (self.from_s..self.until_s).contains(&time_s)
    }

    /// Inertia of the body in the frame of the link.
    pub fn inertia_in_link(&self) -> &Inertia {
        &self.carried.inertia
    }
}

/// Largest mass of a carried body. Kind: numerics; above it, the masses of the links are lost in rounding of the mass matrix.
pub const HEAVIEST_KG: f64 = 1e6;

/// The message about a body that is heavier.
pub fn too_heavy(mass_kg: f64) -> String {
    format!("a mass of {mass_kg:e} kg, limit <= {HEAVIEST_KG:e} kg")
}

/// Warnings for bodies that would be taken after the end of the run.
pub fn taken_too_late(scenario: &Scenario, place: FilePlace<'_>, run_s: f64) -> Vec<Diagnostic> {
    let payloads = scenario.payload.iter().map(|payload| (payload.from_s, &payload.name));
    let grasps = scenario.grasp.iter().map(|grasp| (grasp.from_s, &grasp.body));
    let late = |key: &'static str, index: usize, (from_s, name): (f64, &String)| {
        let place = place.key(key).item(index).key("from_s");
        (from_s >= run_s).then(|| {
            let message =
                format!("\"{name}\" is never carried: from_s = {from_s} s, but the run ends at {run_s} s");
            let warning = Diagnostic::warning(codes::scenario::TAKEN_TOO_LATE, message);
            place.mark(
                warning.with_help("give an earlier `from_s`, or a longer `duration_s` under [simulation]"),
            )
        })
    };
    let payloads = payloads.enumerate().filter_map(|(index, taken)| late("payload", index, taken));
    payloads.chain(grasps.enumerate().filter_map(|(index, taken)| late("grasp", index, taken))).collect()
}
