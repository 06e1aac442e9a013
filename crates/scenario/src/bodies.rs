//! `[[obstacle]] path` and `[[grasp]]`: obstacles that move.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    checks::{UnitKeys, in_two_units},
    number::{
        non_negative, optional_array, optional_non_negative, optional_positive, optional_positive_array,
    },
};

/// A pose on the path of an obstacle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathPoseSettings {
    /// Time at which the obstacle has this pose.
    #[serde(deserialize_with = "non_negative")]
    pub at_s: f64,
    /// Position in the world, in metres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_m: Option<[f64; 3]>,
    /// Position in the world, in millimetres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_mm: Option<[f64; 3]>,
    /// Rotations about the fixed axes x, then y, then z, in degrees.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// Rotations about the fixed axes x, then y, then z, in radians.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_rad: Option<[f64; 3]>,
}

/// An obstacle that a link carries for a time: it keeps the pose that it has in the link at `from_s`, and stays in the world
/// at `until_s`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GraspSettings {
    /// Name of the obstacle that is carried.
    pub body: String,
    /// Link that carries the obstacle; default: the tip of the arm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Time from which the link carries the obstacle.
    #[serde(deserialize_with = "non_negative")]
    pub from_s: f64,
    /// Time at which the link releases the obstacle; default: the end of the run.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
    /// Largest distance of the obstacle from the gripper when it is taken, in metres or in millimetres: from the TCP, or from the
    /// shapes of the link's body and of what is behind it; default: 0.1 m.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub reach_m: Option<f64>,
    /// The same in millimetres.
    #[serde(default, deserialize_with = "optional_non_negative", skip_serializing_if = "Option::is_none")]
    pub reach_mm: Option<f64>,
    /// Mass of the obstacle, which loads the arm while it is carried; default: no mass.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Principal moments of inertia about the centre of mass, along the axes of the obstacle; default: those of a solid of
    /// uniform density (not for a mesh).
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 3]>,
    /// Centre of mass in the obstacle's frame; default: the origin.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
}

impl GraspSettings {
    /// The reach of the gripper, which a file may give in one of two units.
    pub fn reach(&self) -> UnitKeys {
        in_two_units!(self, reach_m, reach_mm)
    }
}
