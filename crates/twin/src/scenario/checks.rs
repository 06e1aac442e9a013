//! `[[check]]`: the checks of a run and their limits.

use congruent_description::serde_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    number::{non_negative, optional_non_negative, optional_positive, positive},
    on_violation::OnViolation,
    pose::PoseSettings,
    text::variant,
};

/// One check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[expect(
    clippy::large_enum_variant,
    reason = "a scenario has a handful of checks, and a box would be in the way"
)]
pub enum Check {
    /// Model against twin: position and orientation of every link, at every sample.
    Agreement(AgreementCheck),
    /// Distance between links and to obstacles.
    Clearance(ClearanceCheck),
    /// Pose or position of the TCP at the end.
    Goal(GoalCheck),
    /// Joint positions within their limits.
    Limits(LimitsCheck),
    /// Forbidden zones.
    Zone(ZoneCheck),
}

/// The kind of a check, as files name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CheckKind {
    /// See [`Check::Agreement`].
    Agreement,
    /// See [`Check::Clearance`].
    Clearance,
    /// See [`Check::Goal`].
    Goal,
    /// See [`Check::Limits`].
    Limits,
    /// See [`Check::Zone`].
    Zone,
}

impl CheckKind {
    /// Every kind.
    pub const ALL: [Self; 5] = [Self::Agreement, Self::Clearance, Self::Goal, Self::Limits, Self::Zone];

    /// The word of files and reports.
    pub fn word(self) -> &'static str {
        serde_name(&self)
    }
}

impl std::fmt::Display for CheckKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.word())
    }
}

impl Check {
    /// Its kind.
    pub fn kind(&self) -> CheckKind {
        match self {
            Self::Agreement(_) => CheckKind::Agreement,
            Self::Clearance(_) => CheckKind::Clearance,
            Self::Goal(_) => CheckKind::Goal,
            Self::Limits(_) => CheckKind::Limits,
            Self::Zone(_) => CheckKind::Zone,
        }
    }

    /// What follows its first violation.
    pub fn on_violation(&self) -> OnViolation {
        match self {
            Self::Agreement(check) => check.on_violation,
            Self::Clearance(check) => check.on_violation,
            Self::Goal(check) => check.on_violation,
            Self::Limits(check) => check.on_violation,
            Self::Zone(check) => check.on_violation,
        }
    }
}

/// Limits that are left out are the robot file's tolerance.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgreementCheck {
    /// Largest distance of the origins of a link.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// Largest angle between the orientations of a link.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// Links come no closer to each other and to obstacles than this.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClearanceCheck {
    /// Smallest distance.
    #[serde(deserialize_with = "non_negative")]
    pub minimum_m: f64,
    /// Only these pairs of links and obstacles are checked, in either order; in a name, `*` stands for any
    /// characters. All pairs if it is left out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pairs: Vec<[String; 2]>,
    /// Pairs that are not checked, likewise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<[String; 2]>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// A pose needs both tolerances, a position one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalCheck {
    /// Pose or position of the twin's TCP at the end, in the world.
    pub tcp: PoseSettings,
    /// Largest distance from it.
    #[serde(deserialize_with = "positive")]
    pub position_m: f64,
    /// Largest angle from it, if the goal has a rotation.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No joint is outside its position limits by more than a tolerance: 1e-6 rad and 1e-6 m if none is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsCheck {
    /// How far beyond its limit a joint that turns may be, in rad or in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_rad: Option<f64>,
    /// The same in degrees.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_deg: Option<f64>,
    /// How far beyond its limit a joint that slides may be, in metres or in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub tolerance_mm: Option<f64>,
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}

/// No link touches a zone that is forbidden to it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZoneCheck {
    /// What follows its first violation.
    #[serde(default, deserialize_with = "variant")]
    pub on_violation: OnViolation,
}
