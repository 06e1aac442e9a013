//! A case of `[uncertainty]`: a scenario with other values, which its controllers do not know.

use std::sync::Arc;

use congruent_description::RobotDescription;
use congruent_dynamics::JointResistance;
use congruent_input::display::quantity_with_digits;
use congruent_monitors::{RunDynamics, RunPayload};
use congruent_scenario::Scenario;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A case, with what its controllers know: the scenario as it is written.
#[derive(Debug, Clone)]
pub struct UncertainCase {
    /// Number of the case, from 0.
    pub case: u64,
    /// Its values.
    pub values: Vec<CaseValue>,
    /// What controllers and planner know, the same in all cases.
    pub known: Arc<KnownValues>,
}

/// What controllers and planner know in all cases of a scenario: its values as they are written.
#[derive(Debug)]
pub struct KnownValues {
    /// The scenario as it is written.
    pub scenario: Scenario,
    /// The robot of the files.
    pub description: RobotDescription,
    pub(super) overrides: Vec<String>,
    pub(super) payloads: Vec<RunPayload>,
    pub(super) resistances: Vec<JointResistance>,
    pub(super) gravity_in_root_m_s2: Vector3<f64>,
}

/// A value of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseValue {
    /// The key, as of --set.
    pub key: String,
    /// The value, as TOML.
    pub value: String,
    /// The nominal value, of the file or of --set, if the distribution is around it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nominal: Option<f64>,
}

impl CaseValue {
    /// The value with five digits, if it is a number.
    pub fn shown(&self) -> String {
        let number = self.value.parse().ok();
        number.map_or_else(|| self.value.clone(), |number: f64| quantity_with_digits(number, "", 5))
    }

    /// `payload.gripper.mass_kg = 1.9659 (nominal 2)`.
    pub fn words(&self) -> String {
        let nominal = self.nominal.map(|value| format!(" (nominal {})", quantity_with_digits(value, "", 5)));
        format!("{} = {}{}", self.key, self.shown(), nominal.unwrap_or_default())
    }
}

impl UncertainCase {
    /// The dynamics of the scenario as it is written.
    pub(crate) fn known_dynamics(&self) -> RunDynamics<'_> {
        let KnownValues { description, payloads, resistances, gravity_in_root_m_s2, .. } = &*self.known;
        RunDynamics::new(&description.robot, payloads, resistances, *gravity_in_root_m_s2)
    }
}
