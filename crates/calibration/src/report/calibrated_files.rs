//! What was written of a calibrated robot.

use schemars::JsonSchema;
use serde::Serialize;

/// The files of a calibrated robot, and where the corrections are in them.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibratedFiles {
    /// The robot file, as it was named.
    pub robot_file: String,
    /// The URDF, as it was named.
    pub urdf: String,
    /// The section of the robot file that has the corrected chain.
    pub model: WrittenModel,
    /// The corrections for which no table has an entry, and which are the reason for screws.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub beyond_the_table: Vec<String>,
    /// The link of the frame in which the rows were measured, which is the base of the written robot; left out if the base was not
    /// displaced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_link: Option<String>,
    /// The link of the camera that measured the rows; left out if none did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_link: Option<String>,
    /// Whether the key `tcp` has a corrected tool.
    pub has_corrected_tcp: bool,
    /// What the nominal robot file has and the written one has not, as its keys.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// Largest distance of the written robot, by its table or screws and by its URDF, from the calibrated chain, m.
    pub position_m: f64,
    /// The same of its orientation, rad.
    pub orientation_rad: f64,
}

/// The section of a written robot file that has the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WrittenModel {
    /// `[dh]`: the table with corrected entries.
    Dh,
    /// `[poe]`: screws.
    Poe,
}
