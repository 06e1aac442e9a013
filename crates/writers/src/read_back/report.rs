//! What reading back has found.

use congruent_description::Robot;
use congruent_input::display::{length, listed};
use congruent_kinematics::Proof;
use schemars::JsonSchema;
use serde::Serialize;

use super::values::Differences;

/// Largest differences of a written robot from the one in its text, read again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ReadBackReport {
    /// Number of links.
    pub links: usize,
    /// Number of moving joints.
    pub joints: usize,
    /// Number of shapes.
    pub shapes: usize,
    /// The limit of each value, relative; of poses in rad and of the size of the robot, at least a metre.
    pub limit: f64,
    /// Largest distance of a link from itself at the configurations, m.
    pub position_m: f64,
    /// Largest angle of a link to itself at the configurations.
    pub orientation_rad: f64,
    /// Largest relative difference of a mass.
    pub mass: f64,
    /// Largest distance of a centre of mass from itself, m; relative beyond a metre.
    pub center_of_mass: f64,
    /// Largest difference of an entry of a tensor, relative to the largest entry.
    pub inertia: f64,
    /// Largest relative difference of a limit, of damping, friction, or of a ratio to another joint.
    pub terms: f64,
    /// Largest difference of a size or a pose of a shape, m or rad.
    pub shape_m: f64,
}

impl ReadBackReport {
    /// The values that are equal, then those that differ by rounding: `masses are equal, inertias agree within 1e-15 (relative)`.
    pub fn values_in_words(&self) -> String {
        let relative = |difference: f64| format!("{difference:.0e} (relative)");
        let values = [
            ("masses", self.mass, relative(self.mass)),
            ("centres of mass", self.center_of_mass, length(self.center_of_mass)),
            ("inertias", self.inertia, relative(self.inertia)),
            ("limits and losses", self.terms, relative(self.terms)),
            ("shapes", self.shape_m, length(self.shape_m)),
        ];
        let (equal, others): (Vec<_>, Vec<_>) = values.into_iter().partition(|(_, found, _)| *found <= 0.0);
        let equal: Vec<&str> = equal.into_iter().map(|(name, ..)| name).collect();
        let equal = (!equal.is_empty()).then(|| format!("{} are equal", listed(&equal)));
        let others = others.into_iter().map(|(name, _, within)| format!("{name} agree within {within}"));
        equal.into_iter().chain(others).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn new(robot: &Robot, differences: &Differences, proof: &Proof, limit: f64) -> Self {
        Self {
            links: robot.links().len(),
            joints: robot.dof(),
            shapes: robot.links().iter().map(|link| link.visuals.len() + link.collisions.len()).sum(),
            limit,
            position_m: proof.position_m,
            orientation_rad: proof.orientation_rad,
            mass: differences.largest("masses"),
            center_of_mass: differences.largest("centres"),
            inertia: differences.largest("inertias"),
            terms: differences.largest("terms"),
            shape_m: differences.largest("shapes"),
        }
    }
}
