//! `[[obstacle]] path` and `[[grasp]]`: obstacles that move.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::number::{non_negative, optional_array, optional_positive, optional_positive_array};

/// A pose on the path of an obstacle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathPoseSettings {
    /// When the obstacle is there.
    #[serde(deserialize_with = "non_negative")]
    pub at_s: f64,
    /// Position in metres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_m: Option<[f64; 3]>,
    /// Position in millimetres.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub xyz_mm: Option<[f64; 3]>,
    /// Turns about the fixed axes x, then y, then z, in degrees.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// Turns about the fixed axes x, then y, then z, in radians.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub rpy_rad: Option<[f64; 3]>,
}

/// An obstacle that a link carries for a time: it keeps the pose that it has in the link at the beginning, and stays where
/// it is left.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GraspSettings {
    /// The name of the obstacle.
    pub body: String,
    /// The link that carries it; the tip of the arm if it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// The link carries it from this time on.
    #[serde(deserialize_with = "non_negative")]
    pub from_s: f64,
    /// The link leaves it at this time; to the end if it is left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub until_s: Option<f64>,
    /// Its mass, which loads the arm meanwhile; none if it is left out.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Its inertia about its centre of mass, along the axes of the obstacle; that of a solid of even density if it is
    /// left out (not for a mesh).
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 3]>,
    /// Its centre of mass in the obstacle's frame; the origin if it is left out.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub com_m: Option<[f64; 3]>,
}
