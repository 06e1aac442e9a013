//! What a calibration says: estimates, what is fixed, what does not fit, where to measure next.

use std::collections::BTreeMap;

use congruent_description::JointValues;
use serde::Serialize;

/// The answer of `congruent calibrate`. Metres and radians throughout.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CalibrationReport {
    /// Name of the robot.
    pub robot: String,
    /// What is corrected: `dh` (the table) or `urdf`.
    pub model: &'static str,
    /// The frame whose pose was measured: a link's name, or `tcp`.
    pub measured_frame: String,
    /// Number of measured rows.
    pub rows: usize,
    /// Number of measured components.
    pub components: usize,
    /// Those in which an estimated correction shows, each configuration once, less the number of these
    /// corrections: what is left to judge by.
    pub redundancy: usize,
    /// Whether the measurements are explained, in one word.
    pub verdict: CalibrationVerdict,
    /// What else the file may have meant, where that would explain it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub likely_reason: Option<LikelyReason>,
    /// Which estimate to use.
    pub recommended: Recommendation,
    /// The same in sentences.
    pub statements: Vec<String>,
    /// The estimates.
    pub parameters: Vec<Estimate>,
    /// What was held at nominal since the measurements do not tell it.
    pub fixed: Vec<ReportedFixedParameter>,
    /// By which figures that was decided.
    pub identifiability: Identifiability,
    /// What is left with the nominal model.
    pub nominal: Remainder,
    /// What least squares leaves.
    pub least_squares: Estimation,
    /// What the robust loss leaves.
    pub robust: Estimation,
    /// The loss of the robust estimate.
    pub loss: &'static str,
    /// Error on rows that the recommended estimate had not seen; `null` for a single configuration.
    pub held_out: Option<HeldOutError>,
    /// Rows that do not fit.
    pub outliers: Vec<RowResidual>,
    /// Every row.
    pub row_residuals: Vec<RowResidual>,
    /// Covariance of the estimated parameters by least squares, in their order.
    pub covariance: Vec<Vec<f64>>,
    /// The cost over the most significant correction; `null` where none is estimated.
    pub cost_curve: Option<CostCurve>,
    /// Configurations that would tell most, the best first.
    pub next: Vec<NextPose>,
}

/// The cost over one correction, the others as estimated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CostCurve {
    /// Index of the correction among `parameters`.
    pub parameter: usize,
    /// Values of it, rad or m.
    pub values: Vec<f64>,
    /// Squared residuals; those of orientations weighted by the noise.
    pub least_squares_m2: Vec<f64>,
    /// The same through the robust loss.
    pub robust_m2: Vec<f64>,
}

/// Whether the corrected model explains the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CalibrationVerdict {
    /// The corrections hold on rows that were left out, and no row stands apart.
    Explained,
    /// Some rows are not explained by any value of the free corrections.
    UnexplainedRows,
    /// What is left is larger than the stated noise of the measurement.
    NoiseExceeded,
    /// On rows that were left out the corrections are no better than the nominal model.
    NoImprovement,
    /// What is left is no noise: too large for the arm, or large and hardly less than without corrections.
    Unexplained,
    /// The corrections explain the measurements only by being as large as the arm, and another reading of the
    /// file does so with small ones.
    Misread,
    /// There are no more measurements than corrections, or all at one configuration: nothing is left to
    /// judge the estimate by.
    NothingToJudgeBy,
    /// Nothing could be identified.
    NothingIdentified,
}

/// Another reading of the measurements under which the same corrections explain them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LikelyReason {
    /// A clause that follows "if".
    pub what: String,
    /// Root mean square distance that would be left.
    pub rms_m: f64,
    /// Root mean square angle that would be left.
    pub rms_rad: f64,
}

/// Which estimate to use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Recommendation {
    /// The nominal model.
    Nominal,
    /// Least squares.
    LeastSquares,
    /// The robust estimate.
    Robust,
}

/// One estimated correction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// `<joint>.<entry>`, `base.<axis>` or `tool.<axis>`.
    pub name: String,
    /// `rad` or `m`.
    pub unit: &'static str,
    /// By least squares.
    pub correction: f64,
    /// Its standard deviation; `null` where the measurements leave nothing to estimate it from.
    pub standard_deviation: f64,
    /// By the robust loss.
    pub robust_correction: f64,
    /// Its standard deviation.
    pub robust_standard_deviation: f64,
    /// Whether the recommended correction is more than two of its standard deviations from zero.
    pub significant: bool,
    /// The entry of the table that it corrects, with the recommended correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_table: Option<TableEntry>,
}

/// A corrected entry of the table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableEntry {
    /// `theta`, `d`, `a` or `alpha`.
    pub entry: &'static str,
    /// What stands there.
    pub found: f64,
    /// What should.
    pub corrected: f64,
    /// Line of the row in the robot file.
    pub line: usize,
}

/// A correction that is held at nominal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedFixedParameter {
    /// Its name.
    pub name: String,
    /// What one unit of it looks like in units of estimated ones; empty for no effect.
    pub correlated_with: BTreeMap<String, f64>,
    /// In words.
    pub reason: String,
}

/// How it was decided what can be identified.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Identifiability {
    /// Smallest admitted ratio of singular values.
    pub threshold: f64,
    /// Of all free corrections, scaled to metres, the largest first.
    pub singular_values: Vec<f64>,
    /// Smallest of the estimated corrections over the largest of all.
    pub kept_ratio: f64,
}

/// What is left of the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Remainder {
    /// Sum of squared position residuals.
    pub cost_m2: f64,
    /// Sum of squared orientation residuals.
    pub cost_rad2: f64,
    /// Root mean square distance.
    pub rms_m: f64,
    /// Root mean square angle.
    pub rms_rad: f64,
    /// Largest distance.
    pub worst_m: f64,
    /// Largest angle.
    pub worst_rad: f64,
}

/// An estimate as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimation {
    /// What it leaves.
    #[serde(flatten)]
    pub left: Remainder,
    /// Noise of one coordinate of a position that it implies, or that was stated; `null` where it is not
    /// known.
    pub noise_m: f64,
    /// Noise of one component of an orientation; likewise.
    pub noise_rad: f64,
    /// Whether the iteration ended below rounding.
    pub converged: bool,
    /// Steps of the last iteration.
    pub iterations: usize,
}

/// Error on rows that were left out.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeldOutError {
    /// Number of parts, each left out once.
    pub folds: usize,
    /// Root mean square distance, outliers of a robust estimate not counted.
    pub rms_m: f64,
    /// Root mean square angle, likewise.
    pub rms_rad: f64,
    /// What the nominal model leaves on the same rows.
    pub nominal_rms_m: f64,
    /// What the nominal model leaves on the same rows.
    pub nominal_rms_rad: f64,
}

/// What is left of one row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RowResidual {
    /// Number of the measurement, from 1.
    pub row: usize,
    /// Line in the file.
    pub line: usize,
    /// Distance with the nominal model.
    pub nominal_m: f64,
    /// Angle with the nominal model.
    pub nominal_rad: f64,
    /// Distance after least squares.
    pub least_squares_m: f64,
    /// Angle after least squares.
    pub least_squares_rad: f64,
    /// Distance after the robust estimate.
    pub robust_m: f64,
    /// Angle after the robust estimate.
    pub robust_rad: f64,
    /// How much the row counts in the robust estimate, 0 to 1.
    pub weight: f64,
}

/// A configuration worth measuring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NextPose {
    /// Joint positions, rad or m.
    pub q: JointValues,
    /// With each bit the volume of the uncertainty is halved.
    pub gain_bits: f64,
}
