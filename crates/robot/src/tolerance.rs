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

/// A tolerance of which one part may be missing: then the digits that are written decide this part, or 1e-9 m and 1e-9 rad if
/// nothing is typed.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, JsonSchema)]
pub struct RequestedTolerance {
    /// Largest distance of the origins, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
    /// Largest angle between the orientations, rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_rad: Option<f64>,
}

impl RequestedTolerance {
    /// Both parts of a tolerance.
    pub fn both(tolerance: Tolerance) -> Self {
        Self { position_m: Some(tolerance.position_m), orientation_rad: Some(tolerance.orientation_rad) }
    }

    /// The tolerance with the parts of another one in place of those that are missing.
    #[must_use]
    pub fn or(self, other: Tolerance) -> Tolerance {
        Tolerance {
            position_m: self.position_m.unwrap_or(other.position_m),
            orientation_rad: self.orientation_rad.unwrap_or(other.orientation_rad),
        }
    }

    /// Whether there is any part.
    pub fn is_declared(&self) -> bool {
        self.position_m.is_some() || self.orientation_rad.is_some()
    }

    /// Whether there is one part and not the other.
    pub fn is_partial(&self) -> bool {
        self.position_m.is_some() != self.orientation_rad.is_some()
    }

    /// Whether a difference is within the parts that there are.
    ///
    /// # Examples
    /// ```
    /// use congruent_robot::RequestedTolerance;
    /// let lengths = RequestedTolerance { position_m: Some(5e-3), orientation_rad: None };
    /// assert!(lengths.allows(1e-3, 0.1) && !lengths.allows(6e-3, 0.0));
    /// ```
    pub fn allows(&self, position_m: f64, orientation_rad: f64) -> bool {
        self.position_m.is_none_or(|most| position_m <= most)
            && self.orientation_rad.is_none_or(|most| orientation_rad <= most)
    }
}
