//! How far two poses may be apart and still count as the same.

use schemars::JsonSchema;
use serde::Serialize;

/// How far two poses may be apart and still count as the same.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Tolerance {
    /// Largest distance of the origins, m.
    pub position_m: f64,
    /// Largest angle between the orientations, rad.
    pub orientation_rad: f64,
}

impl Default for Tolerance {
    /// A nanometre and a nanoradian, which a file that writes pi/2 with ten digits meets.
    fn default() -> Self {
        Self { position_m: 1e-9, orientation_rad: 1e-9 }
    }
}

/// A tolerance that a caller gives in place of a declared one; a part that is missing is the declared one, or 1e-9 if there is
/// none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct RequestedTolerance {
    /// Largest distance of the origins, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// Largest angle between the orientations, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
}
