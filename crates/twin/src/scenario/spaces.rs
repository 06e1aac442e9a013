//! `[[obstacle]]` and `[[zone]]`: shapes that stand around the robot, in the root link's frame.

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
    /// Its radius.
    #[serde(deserialize_with = "positive")]
    pub radius_m: f64,
    /// Its length.
    #[serde(deserialize_with = "positive")]
    pub length_m: f64,
}

/// A body around the robot; exactly one of `box_m`, `sphere_radius_m`, `cylinder` and `mesh` is given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObstacleSettings {
    /// Its name in reports.
    pub name: String,
    /// Edges of a box.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub box_m: Option<[f64; 3]>,
    /// Radius of a sphere.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub sphere_radius_m: Option<f64>,
    /// A cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderSettings>,
    /// A mesh file (STL, OBJ, COLLADA), relative to the scenario, of which the convex hull counts; nothing outside of
    /// the project folder (the nearest at or above the scenario with .git, package.xml or robot.toml) is opened.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
    /// Factors for the coordinates of the mesh, 0.001 for one in millimetres.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
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
    /// Poses at times: the obstacle moves from one to the next, instead of standing still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<PathPoseSettings>,
}

/// Space that is forbidden to some links; shaped and placed as an obstacle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ZoneSettings {
    /// Its name in reports.
    pub name: String,
    /// Names of the links that may not enter, in which `*` stands for any characters.
    #[serde(default, deserialize_with = "strings")]
    pub links: Vec<String>,
    /// Edges of a box.
    #[serde(default, deserialize_with = "optional_positive_array", skip_serializing_if = "Option::is_none")]
    pub box_m: Option<[f64; 3]>,
    /// Radius of a sphere.
    #[serde(default, deserialize_with = "optional_positive", skip_serializing_if = "Option::is_none")]
    pub sphere_radius_m: Option<f64>,
    /// A cylinder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cylinder: Option<CylinderSettings>,
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

impl ZoneSettings {
    /// Its shape and place, without the links.
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
