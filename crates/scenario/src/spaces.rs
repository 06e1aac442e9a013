//! `[[obstacle]]` and `[[zone]]`: shapes around the robot, in the root link's frame.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    bodies::PathPoseSettings,
    number::{optional_array, optional_positive, optional_positive_array, positive},
    text::strings,
};

/// A cylinder along its z axis, its origin in the middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderSettings {
    /// Radius of the cylinder.
    #[serde(deserialize_with = "positive")]
    pub radius_m: f64,
    /// Length of the cylinder along z.
    #[serde(deserialize_with = "positive")]
    pub length_m: f64,
}

/// A body around the robot; exactly one of `box_m`, `sphere_radius_m`, `cylinder` and `mesh` is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObstacleSettings {
    /// Name in reports and messages.
    pub name: String,
    /// Full edge lengths of a box along x, y and z.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub box_m: Option<[f64; 3]>,
    /// Radius of a sphere.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub sphere_radius_m: Option<f64>,
    /// Radius and length of a cylinder along z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderSettings>,
    /// A mesh file (STL, OBJ, COLLADA), relative to the scenario; its convex hull is used. With --fence no file outside the
    /// project folder (the nearest at or above the scenario with .git or package.xml) is opened.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
    /// Factors for the coordinates of the mesh: 0.001 for a mesh in millimetres.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
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
    /// Poses at times: the obstacle moves from one pose to the next instead of being at rest.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<PathPoseSettings>,
}

/// Space that is forbidden to some links; shaped and placed as an obstacle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZoneSettings {
    /// Name in reports and messages.
    pub name: String,
    /// Names of the links that may not enter, in which `*` matches any characters.
    #[serde(default, deserialize_with = "strings")]
    pub links: Vec<String>,
    /// Full edge lengths of a box along x, y and z.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub box_m: Option<[f64; 3]>,
    /// Radius of a sphere.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub sphere_radius_m: Option<f64>,
    /// Radius and length of a cylinder along z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderSettings>,
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

impl ZoneSettings {
    /// Shape and pose of the zone, without the links.
    pub fn space(&self) -> ObstacleSettings {
        let Self { name, links: _, box_m, sphere_radius_m, cylinder, xyz_m, xyz_mm, rpy_deg, rpy_rad } = self;
        ObstacleSettings {
            name: name.clone(),
            box_m: *box_m,
            sphere_radius_m: *sphere_radius_m,
            cylinder: *cylinder,
            xyz_m: *xyz_m,
            xyz_mm: *xyz_mm,
            rpy_deg: *rpy_deg,
            rpy_rad: *rpy_rad,
            ..ObstacleSettings::default()
        }
    }
}
