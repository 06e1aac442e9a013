//! `[[fault]]`: what goes wrong in the twin during a run, unknown to the model, to controllers and to checks.

use congruent_description::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::text::two_strings;

/// One fault. Each kind may have `at_s`, the time from which it is there (0 if left out), and `until_s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum FaultSettings {
    /// The encoder of a joint reads too much by a constant.
    EncoderOffset(EncoderOffsetFault),
    /// What the encoder of a joint reads too much grows with time.
    EncoderDrift(EncoderDriftFault),
    /// Encoder and drive of a joint count the other way round, from the position at which the fault begins.
    FlippedAxis(JointFault),
    /// A joint does not move.
    StuckJoint(JointFault),
    /// The actuator of a joint exerts nothing, whatever it is asked for.
    LostTorque(JointFault),
    /// The actuator of a joint exerts a share of what it is asked for.
    ScaledTorque(ScaledTorqueFault),
    /// More resists a joint than its description says.
    AddedFriction(AddedFrictionFault),
    /// The tool carries a mass of which nobody knows.
    WrongPayload(WrongPayloadFault),
    /// The tool stands elsewhere on the flange.
    ShiftedTool(ShiftedToolFault),
    /// Encoders and drives of two joints are exchanged, both counted from the positions at which the fault begins.
    SwappedJoints(SwappedJointsFault),
    /// The measured state arrives late.
    Latency(LatencyFault),
    /// Some measured states do not arrive: the one before is taken for them.
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
    /// Every kind.
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

/// When a fault is there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FaultTime {
    pub(crate) at_s: f64,
    pub(crate) until_s: Option<f64>,
}

impl FaultSettings {
    /// Its kind.
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

    /// When it is there.
    pub(crate) fn time(&self) -> FaultTime {
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

/// A fault that needs nothing but its joint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointFault {
    /// The joint.
    pub joint: String,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The encoder reads too much by a constant: exactly one unit is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EncoderOffsetFault {
    /// The joint.
    pub joint: String,
    /// By how much, of a joint that turns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_deg: Option<f64>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_rad: Option<f64>,
    /// By how much, of a joint that slides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value_mm: Option<f64>,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// What the encoder reads too much grows with time: exactly one unit is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EncoderDriftFault {
    /// The joint.
    pub joint: String,
    /// How fast, of a joint that turns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_deg_per_s: Option<f64>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_rad_per_s: Option<f64>,
    /// How fast, of a joint that slides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_m_per_s: Option<f64>,
    /// The same in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_mm_per_s: Option<f64>,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The actuator exerts a share of what it is asked for.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaledTorqueFault {
    /// The joint.
    pub joint: String,
    /// The share: above 0 and at most 10, not 1.
    pub share: f64,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// More friction than the description says: dry, viscous or both.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AddedFrictionFault {
    /// The joint.
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
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// A point mass on the tool of which nobody knows.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WrongPayloadFault {
    /// Its mass.
    pub mass_kg: f64,
    /// Where it is, in the frame of the TCP; at its origin if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The tool stands elsewhere: the link `tip` and everything that hangs below it are moved, in the frame of `tip`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShiftedToolFault {
    /// Shift in metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub xyz_m: Option<[f64; 3]>,
    /// Shift in millimetres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub xyz_mm: Option<[f64; 3]>,
    /// Turns about the fixed axes x, then y, then z, in degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// The same in radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_rad: Option<[f64; 3]>,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Encoders and drives of two joints are exchanged.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwappedJointsFault {
    /// The two joints.
    #[serde(deserialize_with = "two_strings")]
    pub joints: [String; 2],
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// The measured state arrives late: positions, speeds and efforts together.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatencyFault {
    /// How late; whole steps.
    pub time_s: f64,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}

/// Some measured states do not arrive.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DroppedSamplesFault {
    /// The share that is lost, above 0 and below 1; which ones, the seed of the scenario decides.
    pub share: f64,
    /// The time from which it is there.
    #[serde(default)]
    pub at_s: f64,
    /// The time at which it ends; never, if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
}
