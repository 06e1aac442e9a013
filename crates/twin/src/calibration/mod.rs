//! `congruent calibrate`: corrections from measurements, with what cannot be known from them.

mod assemble;
mod chain;
mod free;
pub mod measurements;
pub mod plot;
mod reading;
pub mod report;
mod statements;
mod yardstick;

use congruent_description::{Diagnostic, RobotDescription};
use congruent_kinematics::calibration::{
    CorrectedChain, Fit, HeldOut, Identification, Measurement, Problem, RobustFit, Suggestion, fit,
    fit_robustly, fit_with_estimated_noise, held_out, identify, most_telling,
};
pub use congruent_kinematics::calibration::{Loss, Noise};

use chain::NominalChain;
pub use free::GROUPS;
use measurements::MeasuredRow;
use report::{CalibrationReport, Recommendation};

use crate::configurations::random_configurations;

/// Configurations among which the most telling are chosen.
const CANDIDATES: usize = 400;

/// Noise of an ordinary measurement, as a share of the reach and in rad. Kind: judgement; it only weighs
/// suggestions against what is known.
const ORDINARY_NOISE: f64 = 1e-3;

/// What to estimate, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationOptions {
    /// Groups and names of the corrections that are free.
    pub free: Vec<String>,
    /// Groups and names of corrections that are not, whatever `free` says.
    pub hold: Vec<String>,
    /// The robust loss.
    pub loss: Loss,
    /// Smallest admitted ratio of singular values.
    pub threshold: f64,
    /// Noise of the measurement where it is known.
    pub noise: Option<Noise>,
    /// Number of suggested configurations.
    pub suggestions: usize,
    /// Seed of the candidates.
    pub seed: u64,
}

impl Default for CalibrationOptions {
    /// Zero offsets; what moves the tip by less than a thousandth of what the best known correction
    /// does cannot be told from noise.
    fn default() -> Self {
        Self {
            free: vec!["zero-offsets".to_owned()],
            hold: Vec::new(),
            loss: Loss::Tukey,
            threshold: 1e-3,
            noise: None,
            suggestions: 5,
            seed: 0,
        }
    }
}

/// Everything that was computed, before it is put into words.
#[derive(Debug, Clone)]
struct Computed<'a> {
    description: &'a RobotDescription,
    options: &'a CalibrationOptions,
    nominal: NominalChain<'a>,
    chain: CorrectedChain,
    rows: &'a [MeasuredRow],
    measurements: Vec<Measurement>,
    identification: Identification,
    /// Measured components beyond those that the estimated corrections need.
    redundancy: usize,
    least_squares: Fit,
    robust: RobustFit,
    /// Rows that stand apart from the others; none where they would be more than half.
    aside: Vec<usize>,
    held_out: Option<HeldOut>,
    candidates: Vec<Vec<f64>>,
    next: Vec<Suggestion>,
}

/// The coordinates of the configuration vector that every measurement must give.
///
/// # Errors
/// The robot has no chain that could be calibrated.
pub fn needed_coordinates(description: &RobotDescription) -> Result<Vec<usize>, Diagnostic> {
    Ok(NominalChain::new(description)?.coordinates)
}

/// Estimates the free corrections of a robot from measurements.
///
/// # Errors
/// No chain, an unknown or empty choice of corrections.
pub fn calibrate(
    description: &RobotDescription,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
) -> Result<CalibrationReport, Diagnostic> {
    let nominal = NominalChain::new(description)?;
    let parameters = free::parameters(&nominal, &options.free, &options.hold)?;
    let chain = CorrectedChain::new(nominal.chain.clone(), parameters);
    let measurements: Vec<Measurement> = rows.iter().map(|row| measurement(&nominal, row)).collect();
    let problem = Problem { chain: &chain, measurements: &measurements };
    let identification = identify(&problem, options.threshold);
    let redundancy = problem.redundancy(&identification.kept);
    let plain = |problem: &Problem<'_>, kept: &[usize]| match options.noise {
        Some(noise) => fit(problem, kept, noise),
        None => fit_with_estimated_noise(problem, kept),
    };
    let robustly = |problem: &Problem<'_>, kept: &[usize]| {
        fit_robustly(problem, kept, options.loss, (&plain(problem, kept), options.noise))
    };
    let least_squares = plain(&problem, &identification.kept);
    let robust = robustly(&problem, &identification.kept);
    let is_most = 2 * robust.outliers.len() > measurements.len();
    let aside = if is_most { Vec::new() } else { robust.outliers.clone() };
    let use_robust = !aside.is_empty();
    let held_out = held_out(&chain, &measurements, options.threshold, |problem, kept| {
        if use_robust { robustly(problem, kept).fit.corrections } else { plain(problem, kept).corrections }
    });
    let candidates = random_configurations(&description.robot, options.seed, CANDIDATES);
    let in_chain: Vec<Vec<f64>> = candidates.iter().map(|q| nominal.of_configuration(q)).collect();
    let best = if use_robust { &robust.fit } else { &least_squares };
    let is_noise_known = redundancy > 0 || options.noise.is_some();
    let noise = if is_noise_known { best.noise } else { ordinary_noise(&problem) };
    let next = most_telling(&problem, (&best.corrections, &noise), &in_chain, options.suggestions);
    let computed = Computed {
        description,
        options,
        nominal,
        chain,
        rows,
        measurements,
        identification,
        redundancy,
        least_squares,
        robust,
        aside,
        held_out,
        candidates,
        next,
    };
    Ok(assemble::report(&computed))
}

/// A row as the chain sees it.
fn measurement(nominal: &NominalChain<'_>, row: &MeasuredRow) -> Measurement {
    Measurement {
        q: nominal.of_configuration(&row.q),
        tip_in_base_m: row.tip_in_base_m,
        base_from_tip: row.orientation.map(|orientation| orientation.base_from_tip()),
    }
}

/// What is taken for the noise where the measurements leave nothing to estimate it from.
fn ordinary_noise(problem: &Problem<'_>) -> Noise {
    Noise { position_m: ORDINARY_NOISE * problem.reach_m(), orientation_rad: ORDINARY_NOISE }
}

impl Computed<'_> {
    /// The estimate that the words are about: the robust one as soon as a row stands apart.
    fn best(&self) -> (&Fit, Recommendation) {
        if self.aside.is_empty() {
            (&self.least_squares, Recommendation::LeastSquares)
        } else {
            (&self.robust.fit, Recommendation::Robust)
        }
    }
}
