//! `congruent calibrate`: corrections from measurements, and which of them cannot be identified.

use congruent_description::{ChainQ, RobotDescription};
use congruent_input::Diagnostic;
use congruent_kinematics::random_configurations;

use crate::{
    camera::{CameraMount, may_be_seen},
    chain::NominalChain,
    codes,
    computed::{Computed, measurement},
    estimation::{
        CorrectedChain, FOLDS_UNSETTLED, FoldOptions, MOST_FOLDS, Measurement, Noise, Problem, align, fit,
        fit_robustly, fit_with_estimated_noise, held_out, identify, most_informative,
    },
    free,
    measurements::MeasuredRow,
    options::CalibrationOptions,
    report::{CalibrationReport, assemble},
};

/// Number of random configurations among which the most informative are chosen.
const CANDIDATES: usize = 400;

/// Noise of an ordinary measurement, as a share of the reach and in rad. Kind: judgement; it is used only to
/// suggest configurations.
const ORDINARY_NOISE: f64 = 1e-3;

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
/// The robot has no chain, a named correction is unknown, none is free, more configurations are requested than there are
/// candidates, or a row of a camera in the hand has no point.
pub fn calibrate(
    description: &RobotDescription,
    rows: &[MeasuredRow],
    options: &CalibrationOptions,
) -> Result<CalibrationReport, Diagnostic> {
    if options.suggestions > CANDIDATES {
        let message = format!("cannot suggest {} configurations to measure next", options.suggestions);
        return Err(Diagnostic::error(codes::calibrate::NEXT, message).with_help(format!(
            "ask for at most {CANDIDATES}: they are chosen from that many random configurations"
        )));
    }
    may_be_seen(rows, options.camera)?;
    let nominal = NominalChain::new(description)?;
    let parameters = free::parameters(&nominal, &options.free, &options.hold)?;
    let measurements: Vec<Measurement> =
        rows.iter().map(|row| measurement(&nominal, row, options.camera)).collect();
    let at_nominal = CorrectedChain::new(nominal.chain.clone(), parameters);
    let chain = align(&at_nominal, &measurements, options.threshold);
    let problem = Problem { chain: &chain, measurements: &measurements };
    let identification = identify(&problem, options.threshold);
    let redundancy = problem.redundancy(&identification.kept);
    let plain = |problem: &Problem<'_>, kept: &[usize]| match options.noise {
        Some(noise) => fit(problem, kept, noise),
        None => fit_with_estimated_noise(problem, kept),
    };
    let robustly = |problem: &Problem<'_>, kept: &[usize]| {
        fit_robustly(problem, kept, options.loss, &plain(problem, kept), options.noise)
    };
    let least_squares = plain(&problem, &identification.kept);
    let robust = robustly(&problem, &identification.kept);
    // If most rows are outliers, the estimate is wrong rather than the rows.
    let is_most = 2 * robust.outliers.len() > measurements.len();
    let outlier_rows = if is_most { Vec::new() } else { robust.outliers.clone() };
    let use_robust = !outlier_rows.is_empty();
    // An estimate that does not settle is no better on fewer rows, and takes its whole time in each fold.
    let used = if use_robust { &robust.fit } else { &least_squares };
    let folds = if used.converged { MOST_FOLDS } else { FOLDS_UNSETTLED };
    let fold_options = FoldOptions { threshold: options.threshold, most: folds };
    let held_out = held_out(&at_nominal, &measurements, fold_options, |problem, kept| {
        if use_robust { robustly(problem, kept).fit.corrections } else { plain(problem, kept).corrections }
    });
    let candidates = random_configurations(&description.robot, options.seed, CANDIDATES);
    let in_chain: Vec<ChainQ> = candidates.iter().map(|q| nominal.chain_positions(q)).collect();
    let best = if use_robust { &robust.fit } else { &least_squares };
    let is_noise_known = redundancy > 0 || options.noise.is_some();
    // Without redundancy the residuals are zero, and so would be the noise: every gain would be infinite.
    let noise = if is_noise_known { best.noise } else { ordinary_noise(&problem) };
    // Where a camera in the hand sees the target at other configurations is not known.
    let is_in_hand = options.camera == Some(CameraMount::EyeInHand);
    let suggestions = if is_in_hand { 0 } else { options.suggestions };
    let next = most_informative(&problem, &best.corrections, &noise, &in_chain, suggestions);
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
        outlier_rows,
        held_out,
        candidates,
        next,
    };
    Ok(assemble::report(&computed))
}

/// The noise that is assumed if the measurements have no redundancy to estimate it from.
fn ordinary_noise(problem: &Problem<'_>) -> Noise {
    Noise { position_m: ORDINARY_NOISE * problem.reach_m(), orientation_rad: ORDINARY_NOISE }
}
