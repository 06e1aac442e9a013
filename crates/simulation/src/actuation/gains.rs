//! Gains of joint servos.

use crate::error::SimulationError;

/// Gains of a joint servo, the same for every joint: N m/rad and N m s/rad for an angle, N/m and
/// N s/m for a shift.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gains {
    /// Torque per position error.
    pub stiffness: f64,
    /// Torque per velocity error.
    pub damping: f64,
}

impl Gains {
    pub(super) fn check(self) -> Result<Self, SimulationError> {
        let refused = |gain, value: f64| SimulationError::Gain { gain, value };
        for (gain, value) in [("stiffness", self.stiffness), ("damping", self.damping)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(refused(gain, value));
            }
        }
        Ok(self)
    }
}
