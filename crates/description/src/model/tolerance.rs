//! How far two poses may be apart and still count as the same.

use schemars::JsonSchema;
use serde::Serialize;

/// How far two poses may be apart and still count as the same.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Tolerance {
    /// Distance of the origins.
    pub position_m: f64,
    /// Angle between the orientations.
    pub orientation_rad: f64,
}

impl Default for Tolerance {
    /// What files allow that write pi/2 with ten digits: a nanometre and a nanoradian.
    fn default() -> Self {
        Self { position_m: 1e-9, orientation_rad: 1e-9 }
    }
}
