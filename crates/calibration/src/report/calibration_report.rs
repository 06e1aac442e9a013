//! The answer of `congruent calibrate`: estimates, what is fixed, residuals, suggested measurements.

use std::collections::BTreeMap;

use congruent_description::{JointValues, ReportedChain};
use congruent_input::Finding;
use schemars::JsonSchema;
use serde::Serialize;

use super::{calibrated_files::CalibratedFiles, frames::EstimatedFrames};
use crate::{
    camera_frames::CameraFrames,
    estimation::{Loss, ParameterUnit},
};

/// The answer of `congruent calibrate`. Metres and radians throughout.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CalibrationReport {
    /// Name of the robot.
    pub robot: String,
    /// Base and tip, and who named them.
    pub chain: ReportedChain,
    /// The model that is corrected.
    pub model: CalibratedModel,
    /// The frame whose pose was measured: a link's name, `tcp`, or `target` if a camera measured it.
    pub measured_frame: String,
    /// Number of measured rows.
    pub rows: usize,
    /// Number of different configurations among them.
    pub configurations: usize,
    /// Number of measured components.
    pub components: usize,
    /// Degrees of freedom to verify the corrections by: measured components on which an estimated correction
    /// has an effect, each configuration once, less the number of these corrections.
    pub redundancy: usize,
    /// Whether the corrections explain the measurements, as one word.
    pub verdict: CalibrationVerdict,
    /// Another interpretation of the file that would explain the measurements, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub likely_reason: Option<LikelyReason>,
    /// Which estimate to use.
    pub recommended: Recommendation,
    /// Verdict, insignificant and fixed corrections, and convergence, as sentences.
    pub statements: Vec<String>,
    /// The estimated corrections, each with both estimates.
    pub parameters: Vec<EstimatedCorrection>,
    /// Base and tool as they were aligned before the estimate, which starts there; left out if it starts at nominal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aligned: Option<AlignedFrames>,
    /// Base and tool with the recommended estimate; left out if neither is displaced, or a camera measured the rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<EstimatedFrames>,
    /// Camera and target with the recommended estimate; left out if no camera measured the rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraFrames>,
    /// The corrections that are fixed since the measurements do not identify them: at nominal, or where they were aligned.
    pub fixed: Vec<ReportedFixedParameter>,
    /// The singular values by which corrections are identified or fixed.
    pub identifiability: Identifiability,
    /// Residuals of the nominal model.
    pub nominal: ResidualSummary,
    /// Residuals of least squares.
    pub least_squares: FitSummary,
    /// Residuals of the robust estimate.
    pub robust: FitSummary,
    /// The loss of the robust estimate.
    pub loss: Loss,
    /// Residuals of held-out rows with the recommended estimate; `null` for fewer than four configurations.
    pub held_out: Option<HeldOutSummary>,
    /// Outliers: rows that the recommended estimate does not fit.
    pub outliers: Vec<RowResidual>,
    /// Residuals of every measured row.
    pub row_residuals: Vec<RowResidual>,
    /// Covariance of the estimated corrections by least squares, in their order; `null` if it is not known.
    #[schemars(with = "Vec<Vec<Option<f64>>>")]
    pub covariance: Vec<Vec<f64>>,
    /// The cost as a function of the most significant correction; `null` if none is estimated.
    pub cost_curve: Option<CostCurve>,
    /// The most informative configurations to measure next, the best first.
    pub next: Vec<SuggestedConfiguration>,
    /// The files of the calibrated robot; left out if none were written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<CalibratedFiles>,
    /// Warnings about the input.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
}

/// Which model of the robot is corrected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibratedModel {
    /// The DH table of the robot file.
    Dh,
    /// The chain of the URDF.
    Urdf,
}

/// The cost as a function of one correction, the others as estimated.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CostCurve {
    /// Index of the correction among `parameters`.
    pub parameter: usize,
    /// Values of the correction, rad or m.
    pub values: Vec<f64>,
    /// Squared residuals; those of orientations weighted by the noise.
    pub least_squares_m2: Vec<f64>,
    /// The same through the robust loss.
    pub robust_m2: Vec<f64>,
}

/// Whether the corrected model explains the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CalibrationVerdict {
    /// The corrections reduce the residuals of held-out rows, and there is no outlier.
    Explained,
    /// Some rows are not explained by any value of the free corrections.
    UnexplainedRows,
    /// The residuals are larger than the stated noise of the measurement.
    NoiseExceeded,
    /// On held-out rows the corrections are no better than the nominal model.
    NoImprovement,
    /// The residuals are too large for measurement noise, or large and hardly less than without corrections.
    Unexplained,
    /// The corrections explain the measurements only with values as large as the arm, but another interpretation of the file does
    /// so with small ones.
    Misinterpreted,
    /// The corrections explain the measurements only with a length error above a tenth of the reach, too large for an assembly
    /// error; base and tool may be anywhere.
    TooLarge,
    /// The rows explain the corrections, but camera and target could be moved together without any row showing it.
    CameraUndetermined,
    /// There is no redundancy, or there are too few configurations to hold some out: the estimate cannot be verified.
    Unverifiable,
    /// No free correction can be identified.
    NothingIdentified,
}

/// Another interpretation of the measurements under which the same corrections explain them.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LikelyReason {
    /// The interpretation, as a clause after "if".
    pub condition: String,
    /// Root mean square distance under this interpretation, m.
    pub rms_m: f64,
    /// Root mean square angle under this interpretation, rad.
    pub rms_rad: f64,
}

/// Which estimate to use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Recommendation {
    /// The nominal model, without corrections.
    Nominal,
    /// The least-squares estimate.
    LeastSquares,
    /// The robust estimate, which has outliers.
    Robust,
}

/// One estimated correction, by least squares and by the robust loss.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct EstimatedCorrection {
    /// `<joint>.<entry>`, `base.<axis>` or `tool.<axis>`.
    pub name: String,
    /// Unit of the values.
    pub unit: ParameterUnit,
    /// Estimate by least squares, in `unit`.
    pub correction: f64,
    /// Its standard deviation; `null` if the noise is not known and cannot be estimated.
    #[schemars(with = "Option<f64>")]
    pub standard_deviation: f64,
    /// Estimate by the robust loss, in `unit`.
    pub robust_correction: f64,
    /// Its standard deviation; `null` as above.
    #[schemars(with = "Option<f64>")]
    pub robust_standard_deviation: f64,
    /// Whether the recommended correction is more than two of its standard deviations from zero.
    pub significant: bool,
    /// The entry of the table that it corrects, with the recommended correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_table: Option<CorrectedTableEntry>,
}

/// A corrected entry of the table.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct CorrectedTableEntry {
    /// Which entry of the row.
    pub entry: RowEntry,
    /// Its value in the robot file, rad or m.
    pub nominal: f64,
    /// Its corrected value, rad or m.
    pub corrected: f64,
    /// Its line in the robot file; that of its row if the file omits it.
    pub line: usize,
}

/// An entry of a table's row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RowEntry {
    /// Joint angle `theta`, rad.
    Theta,
    /// Link offset `d`, m.
    D,
    /// Link length `a`, m.
    A,
    /// Link twist `alpha`, rad.
    Alpha,
}

/// Base and tool as they were aligned with the measurements before anything was decided about the arm.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AlignedFrames {
    /// The corrections of base and tool by name, m and rad.
    pub corrections: BTreeMap<String, f64>,
    /// Residuals with these alone.
    #[serde(flatten)]
    pub residuals: ResidualSummary,
}

/// A correction that is fixed: at nominal, or where base and tool were aligned.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReportedFixedParameter {
    /// Name of the correction.
    pub name: String,
    /// Unit of its value.
    pub unit: ParameterUnit,
    /// The value at which it is held, in `unit`; 0 is nominal.
    pub held_at: f64,
    /// The estimated corrections that together have nearly the effect of one unit of it, with their values;
    /// empty if it has no effect.
    pub correlated_with: BTreeMap<String, f64>,
    /// Why it is fixed, as a sentence.
    pub reason: String,
}

impl ReportedFixedParameter {
    /// The value at which it is held, with its unit; `None` at nominal.
    pub fn held_at_for_people(&self) -> Option<String> {
        let (value, unit) = (self.unit.for_people(self.held_at), self.unit.name_for_people());
        (self.held_at != 0.0).then(|| format!("at {value:+.4} {unit}"))
    }
}

/// The singular values that decide which corrections are identified.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Identifiability {
    /// Smallest admitted ratio of singular values: corrections below it are fixed.
    pub threshold: f64,
    /// Of all free corrections, scaled to metres, the largest first.
    pub singular_values: Vec<f64>,
    /// Smallest of the estimated corrections over the largest of all.
    pub kept_ratio: f64,
}

/// Residuals of all measurements with one model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ResidualSummary {
    /// Sum of squared position residuals.
    pub cost_m2: f64,
    /// Sum of squared orientation residuals.
    pub cost_rad2: f64,
    /// Root mean square distance over the rows, m.
    pub rms_m: f64,
    /// Root mean square angle over the rows, rad.
    pub rms_rad: f64,
    /// Largest distance of a row, m.
    pub worst_m: f64,
    /// Largest angle of a row, rad.
    pub worst_rad: f64,
}

/// Residuals, noise and convergence of one estimate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct FitSummary {
    /// Residuals with this estimate.
    #[serde(flatten)]
    pub residuals: ResidualSummary,
    /// Noise of one coordinate of a position, estimated from the residuals or as stated; `null` if it is not
    /// known.
    #[schemars(with = "Option<f64>")]
    pub noise_m: f64,
    /// Noise of one component of an orientation, rad; `null` as above.
    #[schemars(with = "Option<f64>")]
    pub noise_rad: f64,
    /// Whether the iteration ended below rounding.
    pub converged: bool,
    /// Steps of the last iteration.
    pub iterations: usize,
}

/// Residuals of held-out rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct HeldOutSummary {
    /// Number of folds, each held out once.
    pub folds: usize,
    /// Root mean square distance without the outliers of a robust estimate, m.
    pub rms_m: f64,
    /// Root mean square angle without the outliers of a robust estimate, rad.
    pub rms_rad: f64,
    /// Root mean square distance with the nominal model on the same rows.
    pub nominal_rms_m: f64,
    /// Root mean square angle with the nominal model on the same rows.
    pub nominal_rms_rad: f64,
}

/// Residual of one row with each model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
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
    /// Weight of the row in the robust estimate, 0 to 1.
    pub weight: f64,
}

/// A configuration to measure next.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SuggestedConfiguration {
    /// Joint positions, rad or m.
    pub q: JointValues,
    /// Information gained, in bits: each bit halves the volume of the uncertainty.
    pub gain_bits: f64,
}

impl CalibrationReport {
    /// Where the fixed corrections are held, in words.
    pub fn held_at(&self) -> &'static str {
        let is_nominal = self.fixed.iter().all(|each| each.held_at == 0.0);
        if is_nominal { "nominal" } else { "nominal or as aligned" }
    }
}

impl std::fmt::Display for CalibratedModel {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(formatter)
    }
}

impl std::fmt::Display for RowEntry {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(formatter)
    }
}
