//! The answer of `congruent calibrate --same-point`.

use congruent_description::ReportedChain;
use congruent_input::Finding;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    estimation::ParameterUnit,
    report::{CalibratedFiles, CalibratedModel, ReportedFixedParameter},
};

/// The answer of `congruent calibrate --same-point`. Metres and radians throughout.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SamePointReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The model that is corrected.
    pub model: CalibratedModel,
    /// The frame whose origin touched the points: a link's name, or `tcp`.
    pub tool_frame: String,
    /// Number of rows of all files.
    pub rows: usize,
    /// Whether the corrections make the tool points of each file coincide better, on rows that they were not estimated from.
    pub verdict: SamePointVerdict,
    /// Verdict, scale and convergence, as sentences.
    pub statements: Vec<String>,
    /// The estimated corrections.
    pub parameters: Vec<SamePointCorrection>,
    /// The corrections that are held at nominal, since the points do not identify them.
    pub fixed: Vec<ReportedFixedParameter>,
    /// The length that gives the scale of the arm, which no point determines; left out if the free corrections cannot change it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale_given_by: Option<String>,
    /// Spread with the nominal model.
    pub nominal: SamePointSpread,
    /// Spread with the corrections.
    pub corrected: SamePointSpread,
    /// Spread of rows that the estimate has not used, about the point of the others of their file; `null` for too few rows.
    pub held_out: Option<SamePointSpread>,
    /// Standard deviation of one coordinate of a row, m.
    pub noise_m: f64,
    /// Whether the last step was below rounding.
    pub converged: bool,
    /// Each file with its point.
    pub points: Vec<TouchedPoint>,
    /// The files of the calibrated robot; left out if none were written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<CalibratedFiles>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Distances of tool points from the mean of their file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct SamePointSpread {
    /// Mean over the rows, m.
    pub mean_m: f64,
    /// Largest, m.
    pub worst_m: f64,
}

/// Whether corrections make tool points coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SamePointVerdict {
    /// The spread of held-out rows is smaller than with the nominal model.
    Explained,
    /// It is not.
    NoImprovement,
    /// It is, but the corrections are none that an arm has, or the points are still far from each other.
    Unexplained,
    /// The rows are too few to hold some out.
    Unverifiable,
    /// No free correction can be identified.
    NothingIdentified,
}

/// A correction that was estimated from points.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SamePointCorrection {
    /// `<joint>.<entry>` or `tool.<axis>`.
    pub name: String,
    /// Unit of the values.
    pub unit: ParameterUnit,
    /// The estimate, in `unit`.
    pub correction: f64,
    /// Its standard deviation.
    pub standard_deviation: f64,
    /// Whether it is more than two standard deviations from zero.
    pub significant: bool,
}

/// A file of configurations with one point.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TouchedPoint {
    /// The file, as it was named.
    pub file: String,
    /// Number of its rows.
    pub rows: usize,
    /// Spread with the nominal model.
    pub nominal: SamePointSpread,
    /// Spread with the corrections.
    pub corrected: SamePointSpread,
    /// The row that is furthest from the point with the corrections, from 1.
    pub worst_row: usize,
    /// The point with the corrections, in link `base`, m.
    pub point_in_base_m: [f64; 3],
}

impl SamePointSpread {
    pub(super) fn of_distances<'a>(distances: impl Iterator<Item = &'a f64> + Clone) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 rows")]
        let count = distances.clone().count().max(1) as f64;
        Self {
            mean_m: distances.clone().sum::<f64>() / count,
            worst_m: distances.fold(0.0, |worst, distance| worst.max(*distance)),
        }
    }
}
