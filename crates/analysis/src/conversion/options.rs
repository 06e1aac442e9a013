//! Options of a conversion: source, target, accuracy.

use std::path::Path;

use congruent_description::{ChainEnd, RobotDescription};
use congruent_input::{Diagnostic, FileAccess};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::codes;

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
    /// A URDF: the whole robot, or of a table and of a chosen chain joints and named links.
    Urdf,
    /// An MJCF, the XML of MuJoCo: the whole robot.
    Mjcf,
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

impl Conversion {
    /// Whether the whole robot is written, with masses and shapes, and not the chain from base to tip.
    ///
    /// # Errors
    /// A part of a robot, or a table, cannot be written as MJCF.
    pub fn is_whole(&self, description: &RobotDescription) -> Result<bool, Diagnostic> {
        let ends = description.chain_ends;
        let has_chain = ends.base == ChainEnd::Given || ends.tip == ChainEnd::Given;
        let is_table = self.from == Some(ConversionSource::Dh);
        match self.to {
            ConversionTarget::Mjcf if is_table => {
                let message = "a table has no masses and no shapes, which an MJCF needs";
                Err(Diagnostic::error(codes::convert::WHOLE, message)
                    .with_help("leave --from out: the robot of the URDF or MJCF is written"))
            }
            ConversionTarget::Mjcf if has_chain => {
                let message = "an MJCF has the whole robot, so --base and --tip choose nothing";
                Err(Diagnostic::error(codes::convert::WHOLE, message).with_help("leave --base and --tip out"))
            }
            ConversionTarget::Mjcf => Ok(true),
            ConversionTarget::Urdf => {
                let from_table = is_table || (self.from.is_none() && description.dh.is_some());
                Ok(!from_table && !has_chain)
            }
            _ => Ok(false),
        }
    }
}

/// Where a whole robot will be written.
#[derive(Debug, Clone, Copy)]
pub struct Destination<'a> {
    /// The path of the file, or of one beside the source if the text is printed; it need not exist, its folder must.
    pub path: &'a Path,
    /// Which files may be opened when the text is read back: the meshes are.
    pub access: &'a FileAccess,
}
