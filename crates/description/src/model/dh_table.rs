//! The Denavit-Hartenberg table as a robot file declares it: figures only. Its meaning, the two
//! conventions' equations, is the business of the kinematics crate.

use nalgebra::Isometry3;

use super::joint::JointIndex;

/// Which of the two equations a table stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// `T = Rz(theta) Tz(d) Tx(a) Rx(alpha)` (Denavit and Hartenberg; Spong).
    Standard,
    /// `T = Rx(alpha) Tx(a) Rz(theta) Tz(d)` (Craig), `a` and `alpha` of the preceding link.
    Modified,
}

/// Which of a row's entries the joint coordinate drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhRowKind {
    /// `theta(q) = theta + sign q`.
    Revolute,
    /// `d(q) = d + sign q`.
    Prismatic,
}

/// One row of a table, and what drives it: a joint of a robot in a declared table, `()` in a table of a chain
/// that belongs to no robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DhRow<J = JointIndex> {
    /// The joint whose position drives the row.
    pub joint: J,
    /// Which entry it drives.
    pub kind: DhRowKind,
    /// Link length.
    pub a_m: f64,
    /// Link twist.
    pub alpha_rad: f64,
    /// Link offset.
    pub d_m: f64,
    /// Joint angle at position zero.
    pub theta_rad: f64,
    /// `1.0` or `-1.0`.
    pub sign: f64,
    /// Line of the row in the robot file, from 1; 0 for a row that was not read from a file.
    pub line: usize,
}

/// A declared table with its constant transforms.
#[derive(Debug, Clone, PartialEq)]
pub struct DhTable {
    /// Which equation the rows stand for.
    pub convention: DhConvention,
    /// Where the figures come from.
    pub source: Option<String>,
    /// Pose of the table's frame 0 in link `base`.
    pub base_from_dh0: Isometry3<f64>,
    /// Pose of link `tip` in the table's last frame.
    pub dhn_from_tip: Isometry3<f64>,
    /// The rows, base to tip; never empty.
    pub rows: Vec<DhRow>,
}
