//! The whole of a scenario.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    bodies::GraspSettings,
    checks::{Check, CheckKind},
    faults::FaultSettings,
    joints::StartSettings,
    motions::{LimitSettings, MotionSettings},
    number::{finite_array, non_negative, optional_positive, positive, share},
    output::OutputSettings,
    robot::{ControllerSettings, JointSettings, PayloadSettings, SensorSettings},
    source::SourceSettings,
    spaces::{ObstacleSettings, ZoneSettings},
    uncertainty::UncertaintySettings,
};

/// The one version of the format that exists.
pub const SCHEMA_VERSION: u32 = 1;

/// A scenario: a robot, its motions, obstacles and zones, and the checks.
///
/// # Examples
/// A scenario made in code has the same content as a file:
/// ```
/// use congruent_scenario::{AgreementCheck, Check, ControllerKind, ControllerSettings, Scenario};
/// let scenario = Scenario {
///     name: "hold".to_owned(),
///     robot: "robots/ur5e".to_owned(),
///     controller: ControllerSettings { kind: ControllerKind::Kinematic, ..ControllerSettings::default() },
///     check: vec![Check::Agreement(AgreementCheck::default())],
///     ..Scenario::default()
/// };
/// assert!(scenario.to_toml().contains("kind = \"agreement\""));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// Version of the format: 1.
    pub schema_version: u32,
    /// Name of the scenario; results go to a folder of this name.
    pub name: String,
    /// A folder with robot.toml, a robot file or a .urdf, relative to the scenario file.
    pub robot: String,
    /// The folder to which paths are relative, and in whose project meshes of obstacles are; default: that of the scenario
    /// file. It is written into resolved scenarios, which are in another folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub folder: Option<String>,
    /// Seed of everything random.
    #[serde(default)]
    pub seed: u64,
    /// Length of a step, duration, gravity and contact with obstacles.
    #[serde(default)]
    pub simulation: SimulationSettings,
    /// Joint positions at the start.
    #[serde(default)]
    pub start: StartSettings,
    /// A log whose joint states the run takes, in place of a simulation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<SourceSettings>,
    /// The controller of the twin; a scenario has one, unless it has a source.
    #[serde(default, skip_serializing_if = "ControllerSettings::is_absent")]
    pub controller: ControllerSettings,
    /// Limits of planned motions.
    #[serde(default)]
    pub limits: LimitSettings,
    /// Resistances and limits of the joints.
    #[serde(default)]
    pub joints: JointSettings,
    /// Resolution and noise of the encoders.
    #[serde(default)]
    pub sensors: SensorSettings,
    /// Bodies that the tool or a link carries.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub payload: Vec<PayloadSettings>,
    /// Motions, one after another.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<MotionSettings>,
    /// Bodies around the robot, at rest or moving.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacle: Vec<ObstacleSettings>,
    /// Obstacles that a link carries for a time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub grasp: Vec<GraspSettings>,
    /// Zones that links may not enter.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zone: Vec<ZoneSettings>,
    /// Faults that are injected into the twin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fault: Vec<FaultSettings>,
    /// The checks of the run, with their limits.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub check: Vec<Check>,
    /// Values that are not known exactly: the checks must hold in cases with other values, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<UncertaintySettings>,
    /// Files that are written in addition to the report and the recording.
    #[serde(default, skip_serializing_if = "OutputSettings::is_default")]
    pub output: OutputSettings,
    /// The expected verdict of the run.
    #[serde(default)]
    pub expect: Expectation,
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            name: String::new(),
            robot: String::new(),
            folder: None,
            seed: 0,
            simulation: SimulationSettings::default(),
            start: StartSettings::default(),
            source: None,
            controller: ControllerSettings::default(),
            limits: LimitSettings::default(),
            joints: JointSettings::default(),
            sensors: SensorSettings::default(),
            payload: Vec::new(),
            motion: Vec::new(),
            obstacle: Vec::new(),
            grasp: Vec::new(),
            zone: Vec::new(),
            fault: Vec::new(),
            check: Vec::new(),
            uncertainty: None,
            output: OutputSettings::default(),
            expect: Expectation::default(),
        }
    }
}

impl Scenario {
    /// The scenario as the text of a file.
    ///
    /// # Panics
    /// For a seed above `i64::MAX`, which TOML does not have; a setup rejects it.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scenario is TOML")
    }
}

/// `[simulation]`: clock, gravity and contact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SimulationSettings {
    /// Length of a physics step.
    #[serde(default = "one_millisecond", deserialize_with = "positive")]
    pub step_s: f64,
    /// Simulated time; default: the run ends with its motions.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// Gravity in the root link's frame.
    #[serde(default = "down", deserialize_with = "finite_array")]
    pub gravity_m_s2: [f64; 3],
    /// Coefficient of friction between links and obstacles.
    #[serde(
        default = "contact_friction",
        deserialize_with = "non_negative",
        skip_serializing_if = "is_contact_friction"
    )]
    pub contact_friction: f64,
    /// Coefficient of restitution between links and obstacles: the share of the speed after an impact, 0 to 1.
    #[serde(default, deserialize_with = "share", skip_serializing_if = "is_zero")]
    pub contact_restitution: f64,
}

/// Coefficient of friction between links and obstacles, if no other is given: dry metal on metal or plastic.
const CONTACT_FRICTION: f64 = 0.5;

fn contact_friction() -> f64 {
    CONTACT_FRICTION
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_contact_friction(value: &f64) -> bool {
    value.total_cmp(&CONTACT_FRICTION).is_eq()
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

fn one_millisecond() -> f64 {
    1e-3
}

fn down() -> [f64; 3] {
    [0.0, 0.0, -9.81]
}

impl Default for SimulationSettings {
    fn default() -> Self {
        Self {
            step_s: one_millisecond(),
            duration_s: None,
            gravity_m_s2: down(),
            contact_friction: CONTACT_FRICTION,
            contact_restitution: 0.0,
        }
    }
}

/// `[expect]`: the expected verdict.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "verdict", rename_all = "snake_case", deny_unknown_fields)]
pub enum Expectation {
    /// Every check is expected to pass.
    #[default]
    Pass,
    /// A negative control: exactly these kinds of check fail (any, if none is named).
    Fail {
        /// Kinds of check that must fail; all others must pass.
        #[serde(default)]
        checks: Vec<CheckKind>,
    },
}
