//! A case of `[uncertainty]`: a scenario with other values, which its controllers do not know.

use congruent_description::Robot;
use congruent_dynamics::JointResistance;
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
    /// The scenario as it is written.
    pub scenario: Scenario,
    pub(super) robot: Robot,
    pub(super) payloads: Vec<RunPayload>,
    pub(super) resistances: Vec<JointResistance>,
    pub(super) gravity_in_root_m_s2: Vector3<f64>,
}

/// A value of a case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CaseValue {
    /// The key, as of --set.
    pub key: String,
    /// The value, as TOML.
    pub value: String,
}

impl UncertainCase {
    /// The dynamics of the scenario as it is written.
    pub(crate) fn known_dynamics(&self) -> RunDynamics<'_> {
        RunDynamics::new(&self.robot, &self.payloads, &self.resistances, self.gravity_in_root_m_s2)
    }
}
