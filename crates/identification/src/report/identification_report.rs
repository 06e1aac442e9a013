//! The answer of `congruent identify`.

use congruent_input::{ChangedLines, Finding};
use schemars::JsonSchema;
use serde::Serialize;

use crate::{effort_kind::EffortKind, unknowns::JointUnknown};

/// Whether the identified parameters are better than those of the description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum IdentificationVerdict {
    /// They predict efforts that they were not estimated from better than the description does.
    Better,
    /// They do not.
    NotBetter,
}

/// What the efforts are.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct EffortReport {
    /// Their kind.
    pub kind: EffortKind,
    /// Whether the caller said so; otherwise it is the kind as which the description explains them best.
    pub is_declared: bool,
    /// Part of their variance that is left if they are torques; null if they do not change.
    pub left_as_torque: f64,
    /// The same for torques without those of gravity.
    pub left_as_torque_without_gravity: f64,
    /// The same for currents.
    pub left_as_current: f64,
    /// For each driven joint the torque for a unit of its effort, of currents.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub torque_constants: Vec<TorqueConstant>,
}

/// What the current of a joint has to be multiplied by.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TorqueConstant {
    /// The joint.
    pub joint: String,
    /// Torque of the joint for a unit of its effort; null if gravity and inertia have too small a part in it.
    pub value: Option<f64>,
    /// Its standard error; null if the caller gave the value.
    pub standard_error: Option<f64>,
    /// `N m/A` or `N/A`.
    pub unit: &'static str,
}

/// A value with its uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ValueWithError {
    /// As identified.
    pub value: f64,
    /// Its standard error, with the relation of neighbouring instants.
    pub standard_error: f64,
    /// As the description has it.
    pub nominal: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// A term of a joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TermReport {
    /// Which.
    pub term: JointUnknown,
    /// Its value.
    #[serde(flatten)]
    pub value: ValueWithError,
    /// Whether it differs from zero by at least two standard errors.
    pub is_significant: bool,
}

/// A driven joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct IdentifiedJointReport {
    /// Its name.
    pub joint: String,
    /// Instants at which it moved fast enough.
    pub instants: usize,
    /// Root mean square of its effort, in the unit of its terms.
    pub effort_rms: f64,
    /// The residual of the effort by the description, root mean square.
    pub before_rms: f64,
    /// What the identified parameters leave of it in data that they were not estimated from.
    pub after_rms: f64,
    /// How many instants count as one, since neighbouring ones are alike.
    pub alike: f64,
    /// `N m` or `N`.
    pub unit: &'static str,
    /// Its identified terms.
    pub terms: Vec<TermReport>,
}

/// Terms of a joint of which the recording shows the sum alone.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct IndistinctTerms {
    /// The joint.
    pub joint: String,
    /// The term that was kept as the description has it.
    pub kept: JointUnknown,
    /// The terms that have its effect, too; none if it has no effect in this recording.
    pub like: Vec<JointUnknown>,
}

/// A body: a payload, or all that fixed joints hold to the link of a joint.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BodyReport {
    /// The joint that carries it.
    pub joint: String,
    /// The frame of its centre and its tensor: the link of the joint, or that of the payload.
    pub frame: String,
    /// Mass.
    pub mass: ValueWithError,
    /// Centre of mass in the frame, m.
    pub center_m: [f64; 3],
    /// Its standard errors, m.
    pub center_error_m: [f64; 3],
    /// Its place in the description, m; null without a mass there.
    pub nominal_center_m: Option<[f64; 3]>,
    /// Tensor about the centre of mass, in the axes of the frame: xx, xy, xz, yy, yz, zz, kg m^2.
    pub inertia_kg_m2: [f64; 6],
    /// Its standard errors, kg m^2.
    pub inertia_error_kg_m2: [f64; 6],
}

/// Lines to write.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WrittenLines {
    /// Lines of the URDF or MJCF that change.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub of_description: Vec<ChangedLines>,
    /// The file that they are in.
    pub file: String,
    /// Entries `[[inertial]]` for a robot file.
    pub of_robot_file: String,
    /// `[joints]` and `[[payload]]` for a scenario.
    pub of_scenario: String,
    /// What the description cannot have, and why.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_in_description: Vec<String>,
}

/// The answer of `congruent identify`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct IdentificationReport {
    /// Path of the description.
    pub file: String,
    /// Name of the robot.
    pub robot: String,
    /// Path of the log.
    pub log: String,
    /// Whether the parameters are better.
    pub verdict: IdentificationVerdict,
    /// What the efforts are.
    pub effort: EffortReport,
    /// Half of the window in which positions are smoothed and derived, s.
    pub half_window_s: f64,
    /// Whether instants at rest were taken, at which gravity acts alone.
    pub is_of_still_poses: bool,
    /// Instants that were used.
    pub instants: usize,
    /// Joints that the log does not have, which were taken to stand still at their start.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joints_not_in_log: Vec<String>,
    /// By how much efforts are recorded later than positions, s; negative if earlier; null if it does not show.
    pub effort_delay_s: Option<f64>,
    /// Its standard error, s.
    pub effort_delay_error_s: Option<f64>,
    /// The driven joints.
    pub joints: Vec<IdentifiedJointReport>,
    /// Terms that cannot be distinguished.
    pub indistinct: Vec<IndistinctTerms>,
    /// The payload.
    pub payload: Option<BodyReport>,
    /// The bodies, if their masses were identified.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyReport>,
    /// Combinations of the inertial parameters that were free and of which the recording says more than was known before.
    pub known_combinations: usize,
    /// Inertial parameters that were free.
    pub free_inertial_parameters: usize,
    /// The lines to write; null unless the parameters are better.
    pub lines: Option<WrittenLines>,
    /// Files with these lines that were written.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub written: Vec<String>,
    /// Warnings.
    pub warnings: Vec<Finding>,
}
