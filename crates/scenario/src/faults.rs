//! `[[fault]]`: faults of the twin during a run, unknown to the model, to controllers and to checks.

use congruent_input::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::text::two_strings;

/// One fault. Each kind may have `at_s`, its start (default 0), and `until_s`, its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum FaultSettings {
    /// The encoder of a joint has a constant offset.
    EncoderOffset(EncoderOffsetFault),
    /// The encoder of a joint has an offset that grows with time.
    EncoderDrift(EncoderDriftFault),
    /// Encoder and drive of a joint count the other way round, from the position at which the fault begins.
    FlippedAxis(JointFault),
    /// A joint does not move.
    StuckJoint(JointFault),
    /// The actuator of a joint exerts no effort, whatever is commanded.
    LostTorque(JointFault),
    /// The actuator of a joint exerts a share of the commanded effort.
    ScaledTorque(ScaledTorqueFault),
    /// A joint has more friction than its description says.
    AddedFriction(AddedFrictionFault),
    /// The tool carries a mass that is not declared.
    WrongPayload(WrongPayloadFault),
    /// The tool is mounted at another pose on the flange.
    ShiftedTool(ShiftedToolFault),
    /// Encoders and drives of two joints are exchanged, both counted from the positions at which the fault begins.
    SwappedJoints(SwappedJointsFault),
    /// The measured state arrives late.
    Latency(LatencyFault),
    /// Some measured states do not arrive: the previous one is used instead.
    DroppedSamples(DroppedSamplesFault),
}

/// The kind of a fault, as files name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// See [`FaultSettings::EncoderOffset`].
    EncoderOffset,
    /// See [`FaultSettings::EncoderDrift`].
    EncoderDrift,
    /// See [`FaultSettings::FlippedAxis`].
    FlippedAxis,
    /// See [`FaultSettings::StuckJoint`].
    StuckJoint,
    /// See [`FaultSettings::LostTorque`].
    LostTorque,
    /// See [`FaultSettings::ScaledTorque`].
    ScaledTorque,
    /// See [`FaultSettings::AddedFriction`].
    AddedFriction,
    /// See [`FaultSettings::WrongPayload`].
    WrongPayload,
    /// See [`FaultSettings::ShiftedTool`].
    ShiftedTool,
    /// See [`FaultSettings::SwappedJoints`].
    SwappedJoints,
    /// See [`FaultSettings::Latency`].
    Latency,
    /// See [`FaultSettings::DroppedSamples`].
    DroppedSamples,
}

impl FaultKind {
    /// Every kind of fault.
    pub const ALL: [Self; 12] = [
        Self::EncoderOffset,
        Self::EncoderDrift,
        Self::FlippedAxis,
        Self::StuckJoint,
        Self::LostTorque,
        Self::ScaledTorque,
        Self::AddedFriction,
        Self::WrongPayload,
        Self::ShiftedTool,
        Self::SwappedJoints,
        Self::Latency,
        Self::DroppedSamples,
    ];

    /// The word of files and reports.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

impl std::fmt::Display for FaultKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.word())
    }
}

/// Start and end of a fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaultTime {
    /// From this time on.
    pub at_s: f64,
    /// Up to this time; `None` if it lasts to the end of the run.
    pub until_s: Option<f64>,
}

impl FaultSettings {
    /// The kind of the fault.
    pub fn kind(&self) -> FaultKind {
        match self {
            Self::EncoderOffset(_) => FaultKind::EncoderOffset,
            Self::EncoderDrift(_) => FaultKind::EncoderDrift,
            Self::FlippedAxis(_) => FaultKind::FlippedAxis,
            Self::StuckJoint(_) => FaultKind::StuckJoint,
            Self::LostTorque(_) => FaultKind::LostTorque,
            Self::ScaledTorque(_) => FaultKind::ScaledTorque,
            Self::AddedFriction(_) => FaultKind::AddedFriction,
            Self::WrongPayload(_) => FaultKind::WrongPayload,
            Self::ShiftedTool(_) => FaultKind::ShiftedTool,
            Self::SwappedJoints(_) => FaultKind::SwappedJoints,
            Self::Latency(_) => FaultKind::Latency,
            Self::DroppedSamples(_) => FaultKind::DroppedSamples,
        }
    }

    /// Start and end of the fault.
    pub fn time(&self) -> FaultTime {
        let (at_s, until_s) = match self {
            Self::EncoderOffset(fault) => (fault.at_s, fault.until_s),
            Self::EncoderDrift(fault) => (fault.at_s, fault.until_s),
            Self::FlippedAxis(fault) | Self::StuckJoint(fault) | Self::LostTorque(fault) => {
                (fault.at_s, fault.until_s)
            }
            Self::ScaledTorque(fault) => (fault.at_s, fault.until_s),
            Self::AddedFriction(fault) => (fault.at_s, fault.until_s),
            Self::WrongPayload(fault) => (fault.at_s, fault.until_s),
            Self::ShiftedTool(fault) => (fault.at_s, fault.until_s),
            Self::SwappedJoints(fault) => (fault.at_s, fault.until_s),
            Self::Latency(fault) => (fault.at_s, fault.until_s),
            Self::DroppedSamples(fault) => (fault.at_s, fault.until_s),
        };
        FaultTime { at_s, until_s }
    }
}

/// A fault of one joint, without a value.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointFault {
    /// Name of the joint that has the fault.
    pub joint: String,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The encoder has a constant offset: exactly one unit is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EncoderOffsetFault {
    /// Name of the joint that has the fault.
    pub joint: String,
    /// Offset of the encoder of a turning joint: reading minus position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_deg: Option<f64>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_rad: Option<f64>,
    /// Offset of the encoder of a sliding joint: reading minus position.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_mm: Option<f64>,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The encoder has an offset that grows with time: exactly one unit is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EncoderDriftFault {
    /// Name of the joint that has the fault.
    pub joint: String,
    /// Rate of the offset of a turning joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_deg_per_s: Option<f64>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_rad_per_s: Option<f64>,
    /// Rate of the offset of a sliding joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_m_per_s: Option<f64>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_mm_per_s: Option<f64>,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The actuator exerts a share of the commanded effort.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaledTorqueFault {
    /// Name of the joint that has the fault.
    pub joint: String,
    /// Exerted effort divided by commanded effort: above 0 and at most 10, not 1.
    pub share: f64,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// More friction than the description says: dry, viscous or both.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddedFrictionFault {
    /// Name of the joint that has the fault.
    pub joint: String,
    /// Dry friction of a joint that turns, N m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_n_m: Option<f64>,
    /// Dry friction of a joint that slides, N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_n: Option<f64>,
    /// Viscous friction of a joint that turns, N m s/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_n_m_s_per_rad: Option<f64>,
    /// Viscous friction of a joint that slides, N s/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_n_s_per_m: Option<f64>,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// A point mass on the tool that is not declared.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrongPayloadFault {
    /// Mass of the point.
    pub mass_kg: f64,
    /// Position of the mass in the frame of the TCP; default: its origin.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The tool is mounted at another pose: the link `tip` and every link below it are moved, in the frame of `tip`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShiftedToolFault {
    /// Displacement of the tool, in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub xyz_m: Option<[f64; 3]>,
    /// Displacement of the tool, in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub xyz_mm: Option<[f64; 3]>,
    /// Rotations about the fixed axes x, then y, then z, in degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_rad: Option<[f64; 3]>,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Encoders and drives of two joints are exchanged.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwappedJointsFault {
    /// Names of the two joints.
    #[serde(deserialize_with = "two_strings")]
    pub joints: [String; 2],
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The measured state arrives late: positions, speeds and efforts together.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatencyFault {
    /// Delay of the measured state: a whole number of steps.
    pub time_s: f64,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Some measured states do not arrive.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DroppedSamplesFault {
    /// Probability that a measured state is lost, above 0 and below 1; the seed of the scenario decides which.
    pub share: f64,
    /// Start of the fault, from the start of the run.
    #[serde(default)]
    pub at_s: f64,
    /// End of the fault; default: the end of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}
