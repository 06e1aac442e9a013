//! Where base and tool are, before anything is decided about the corrections of the arm.
//!
//! A tracker is metres away from the base of the arm and measures a target that is turned against its flange. Corrections are
//! linearised, so about the nominal frames their effects, and which of them can be distinguished, would be those of another
//! cell. Closed forms give the two frames; least squares of the two alone makes them accurate.

mod closed_form;
mod frames;
mod free_frames;
mod rotations;
mod rows;

use congruent_description::ChainQ;
use congruent_kinematics::{Pose, ScrewChain};

use super::{
    estimate::{MOST_ITERATIONS, weighted_fit},
    identify::identify,
    model::{CorrectedChain, CorrectionEntry, base_pose, tool_pose},
    problem::{Measurement, Problem, Weighting},
    robust::{Loss, comparable_noise, concentrated, distance},
};
use closed_form::aligned_by_closed_forms;
use frames::BaseAndTool;
use free_frames::FreeFrames;
use rows::{AlignmentRow, median_size_m};

/// Base and tool are right enough to begin with if the median row agrees within this share of the reach, or this angle in rad.
/// Kind: judgement: there the linearisation at nominal holds, and what is not identified stays at nominal, which is easier to
/// use than any other value.
const RIGHT_WITHIN: f64 = 0.03;
/// Aligned frames are used if they reduce the median residual to this share or less. Kind: judgement: otherwise the frames are
/// not the reason for it, and values at which corrections are held should not depend on it.
const MUCH_SMALLER: f64 = 0.5;

/// The chain, starting at aligned frames if all six corrections of base or tool are free, the nominal frames disagree with the
/// measurements, and the aligned ones agree much better; otherwise as it is.
///
/// At least half of the rows must be of this robot. `threshold` is that of [`identify`].
///
/// # Panics
/// If a measurement's `q` has another length than the chain has joints.
pub fn align(chain: &CorrectedChain, measurements: &[Measurement], threshold: f64) -> CorrectedChain {
    let Some(free) = FreeFrames::of(chain) else { return chain.clone() };
    let problem = Problem { chain, measurements };
    let reach_m = problem.reach_m();
    let nominal_m = median_size_m(&problem.residuals(chain.start()), reach_m);
    if nominal_m <= RIGHT_WITHIN * reach_m {
        return chain.clone();
    }
    let nominal = chain.at(chain.start());
    let found = found_in_closed_form(measurements, &free, threshold, reach_m, |q| nominal.base_from_tip(q));
    let Some(found) = found else { return chain.clone() };
    let fitted = fitted(chain.nominal(), measurements, &free, found, threshold);
    let start = free.start(chain, &fitted);
    let aligned_m = median_size_m(&problem.residuals(&start), reach_m);
    if aligned_m <= MUCH_SMALLER * nominal_m { chain.starting_at(start) } else { chain.clone() }
}

/// Base and tool in closed form. A camera at the tip measured the target in its own frame, which is the frame of the
/// measurements if the chain is gone through from the tip to the base.
fn found_in_closed_form(
    measurements: &[Measurement],
    free: &FreeFrames,
    threshold: f64,
    reach_m: f64,
    base_from_tip: impl Fn(&ChainQ) -> Pose,
) -> Option<BaseAndTool> {
    let which = free.which();
    let seen: Option<Vec<Measurement>> = measurements.iter().map(Measurement::in_the_camera).collect();
    let Some(seen) = seen else {
        let rows = aligned_rows(measurements, base_from_tip);
        return aligned_by_closed_forms(&rows, which, threshold, reach_m);
    };
    let rows = aligned_rows(&seen, |q| base_from_tip(q).inverse());
    let found = aligned_by_closed_forms(&rows, which.reversed(), threshold, reach_m)?;
    Some(found.reversed())
}

fn aligned_rows(measurements: &[Measurement], pose: impl Fn(&ChainQ) -> Pose) -> Vec<AlignmentRow<'_>> {
    measurements.iter().map(|measured| AlignmentRow { base_from_tip: pose(&measured.q), measured }).collect()
}

/// Least squares of base and tool alone, over the rows that agree with the better half of them.
///
/// The frames become those of the chain, so that the corrections are small: about the aligned pose roll and yaw can be
/// distinguished also if its pitch is a quarter turn.
fn fitted(
    nominal: &ScrewChain,
    measurements: &[Measurement],
    free: &FreeFrames,
    found: BaseAndTool,
    threshold: f64,
) -> BaseAndTool {
    let moved = ScrewChain {
        twists_in_base: nominal
            .twists_in_base
            .iter()
            .map(|twist| twist.transformed_by(&found.measured_from_base))
            .collect(),
        base_from_tip_at_zero: found.measured_from_base
            * nominal.base_from_tip_at_zero
            * found.tip_from_target,
    };
    let which = free.which();
    let mut parameters = if which.base { base_pose() } else { Vec::new() };
    parameters.extend(if which.tool { tool_pose(&moved) } else { Vec::new() });
    let chain = CorrectedChain::new(moved, parameters);
    let problem = Problem { chain: &chain, measurements };
    let kept = identify(&problem, threshold).kept;
    let residuals = problem.residuals(chain.start());
    let noise = comparable_noise(&problem, &residuals).floored();
    let half = concentrated(&problem, &kept, chain.start().to_vec(), &residuals, noise);
    // The half has found the outliers; all other rows determine the frames.
    let noise = comparable_noise(&problem, &half.residuals).floored();
    let rows = measurements.iter().zip(&half.residuals);
    let weights: Vec<f64> =
        rows.map(|(measured, residual)| Loss::Tukey.weight(distance(measured, residual, &noise))).collect();
    let weighting = Weighting { noise, rows: &weights };
    let fit = weighted_fit(&problem, &kept, half.corrections, &weighting, MOST_ITERATIONS);
    let of = |entry: CorrectionEntry| {
        let parameters = chain.parameters().iter().zip(&fit.corrections);
        let exponentials = parameters
            .filter(|(parameter, _)| parameter.entry == entry)
            .map(|(parameter, p)| parameter.generator_in_base.exp(*p));
        exponentials.fold(Pose::identity(), |product, next| product * next)
    };
    // The generators of the tool are in the base at zero: exp(G) M = M tool_correction.
    let at_zero = chain.nominal().base_from_tip_at_zero;
    let tool_correction = at_zero.inverse() * of(CorrectionEntry::Tool) * at_zero;
    BaseAndTool {
        measured_from_base: of(CorrectionEntry::Base) * found.measured_from_base,
        tip_from_target: found.tip_from_target * tool_correction,
    }
}
