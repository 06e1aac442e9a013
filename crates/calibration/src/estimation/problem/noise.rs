//! Noise of a measurement, and what follows for the statistics of one row.

/// Standard deviation of each measured component; also the weight of the two kinds of residual
/// against each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Of one coordinate of a position.
    pub position_m: f64,
    /// Of one component of an orientation (axis times angle).
    pub orientation_rad: f64,
}

/// Smallest noise of a measurement: rounding in perfect data is not taken for signal.
/// Kind: floor; rounding of a chain within 2 m is 1e-15.
const NOISE_FLOOR: f64 = 1e-12;

/// Median of the chi distribution for 1 to 6 components: half of all rows have a smaller norm.
const CHI_MEDIAN: [f64; 6] = [0.674_490, 1.177_410, 1.538_172, 1.832_128, 2.086_015, 2.312_600];

/// Its quantile 0.9999: one row in 10,000 has a larger norm by chance.
const CHI_9999: [f64; 6] = [3.890_592, 4.291_932, 4.594_291, 4.848_994, 5.073_937, 5.277_911];

impl Noise {
    /// Nothing below the floor.
    #[must_use]
    pub(in crate::estimation) fn floored(self) -> Self {
        Self {
            position_m: self.position_m.max(NOISE_FLOOR),
            orientation_rad: self.orientation_rad.max(NOISE_FLOOR),
        }
    }
}

/// The norm that half of all rows with this many components stay below.
pub(in crate::estimation) fn median_norm(components: usize) -> f64 {
    CHI_MEDIAN[components.clamp(1, 6) - 1]
}

/// The norm that one row in 10,000 with this many components exceeds.
pub(in crate::estimation) fn outlying_norm(components: usize) -> f64 {
    CHI_9999[components.clamp(1, 6) - 1]
}
