//! The Denavit-Hartenberg table as a robot file declares it: values only. The kinematics crate computes
//! with it.

use congruent_input::serde_name;
use nalgebra::Isometry3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::joint::JointIndex;

/// The equation of a row: the order of its four elementary transforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DhConvention {
    /// `T = Rz(theta) Tz(d) Tx(a) Rx(alpha)` (Denavit and Hartenberg; Spong).
    Standard,
    /// `T = Rx(alpha) Tx(a) Rz(theta) Tz(d)` (Craig), `a` and `alpha` of the preceding link.
    Modified,
}

impl DhConvention {
    /// The name of the variant in files and reports.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }

    /// The transform of a row as a product.
    pub fn equation(self) -> &'static str {
        match self {
            Self::Standard => "Rz(theta) Tz(d) Tx(a) Rx(alpha)",
            Self::Modified => "Rx(alpha) Tx(a) Rz(theta) Tz(d)",
        }
    }
}

/// Which of a row's entries the joint coordinate drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DhRowKind {
    /// `theta(q) = theta + sign q`.
    Revolute,
    /// `d(q) = d + sign q`.
    Prismatic,
}

impl DhRowKind {
    /// The name of the variant in files and reports.
    pub fn name(self) -> &'static str {
        serde_name(&self)
    }
}

/// One row of a table, and what drives it: a joint of a robot in a declared table, `()` in a table of a chain
/// that belongs to no robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DhRow<J = JointIndex> {
    /// The joint whose position drives the row.
    pub joint: J,
    /// The entry that the joint position is added to.
    pub kind: DhRowKind,
    /// Link length a, m.
    pub a_m: f64,
    /// Link twist alpha, rad.
    pub alpha_rad: f64,
    /// Link offset d, m; of a prismatic row, d at position zero.
    pub d_m: f64,
    /// Joint angle theta, rad; of a revolute row, theta at position zero.
    pub theta_rad: f64,
    /// Sign of the joint position in the row: `1.0` or `-1.0`.
    pub sign: f64,
    /// Line of the row in the robot file, from 1; 0 if it was not read from one.
    pub line: usize,
}

/// A declared table with its constant transforms.
#[derive(Debug, Clone, PartialEq)]
pub struct DhTable {
    /// The equation of the rows.
    pub convention: DhConvention,
    /// The publication that the values are from.
    pub source: Option<String>,
    /// Pose of the table's frame 0 in link `base`.
    pub base_from_dh0: Isometry3<f64>,
    /// Pose of link `tip` in the table's last frame.
    pub dhn_from_tip: Isometry3<f64>,
    /// The rows, base to tip; never empty.
    pub rows: Vec<DhRow>,
}
