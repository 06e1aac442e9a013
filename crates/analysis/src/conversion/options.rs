//! Options of a conversion: source, target, accuracy.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest error of a conversion unless a coarser one is given: rad and m.
pub const DEFAULT_ACCURACY: f64 = 1e-12;

/// The model that a robot is converted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConversionTarget {
    /// A table with rows Rz(theta) Tz(d) Tx(a) Rx(alpha).
    Standard,
    /// A table with rows Rx(alpha) Tx(a) Rz(theta) Tz(d) (Craig).
    Modified,
    /// Space and body screws with the home pose.
    Poe,
    /// A URDF of joints and named links.
    Urdf,
}

/// Which model of the robot is converted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConversionSource {
    /// The table of robot.toml.
    Dh,
    /// The chain of the URDF.
    Urdf,
}

/// How a table treats axes that are parallel or intersecting within rounded values, such as a quarter turn of 1.5708.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RoundedAxes {
    /// They are made parallel or intersecting; the table differs from the source by the effect of the rounding.
    #[default]
    Corrected,
    /// They are kept; the table is exact, and its values may be huge.
    Kept,
}

/// How a model is converted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conversion {
    /// Which model is converted; for `None` the declared table if there is one, otherwise the URDF.
    pub from: Option<ConversionSource>,
    /// The model that it is converted to.
    pub to: ConversionTarget,
    /// Largest error of the result, rad and m.
    pub accuracy: f64,
    /// Seed of the random configurations.
    pub seed: u64,
    /// How a table treats axes that are parallel or intersecting within rounded values.
    pub rounded_axes: RoundedAxes,
}
