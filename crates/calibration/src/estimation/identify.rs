//! Which corrections the measurements identify, and what the others are correlated with.

use nalgebra::{DMatrix, SymmetricEigen};

use super::{
    model::{CorrectedChain, CorrectionParameter, ParameterUnit},
    problem::{CalibrationEquations, Noise, Problem, Weighting},
};

/// Corrections with a smaller share of the largest factor are not listed in a relation. No unit; kind: display.
const NEGLIGIBLE_SHARE: f64 = 0.01;

/// Which corrections the measurements identify.
///
/// Singular values are those of the Jacobian at the chain's start in scaled units, angles and orientations
/// times the reach, divided by the root of the number of components: metres at the tip for a metre
/// of correction.
#[derive(Debug, Clone, PartialEq)]
pub struct Identification {
    /// Indices of the corrections that are estimated, ascending.
    pub kept: Vec<usize>,
    /// The others, fixed (held at the chain's start), with what they are correlated with.
    pub fixed: Vec<FixedParameter>,
    /// Of all corrections together, the largest first.
    pub singular_values: Vec<f64>,
    /// Smallest of those kept, over the largest of all.
    pub kept_ratio: f64,
}

/// A correction that is fixed (held at the chain's start).
#[derive(Debug, Clone, PartialEq)]
pub struct FixedParameter {
    /// Index of the correction.
    pub parameter: usize,
    /// The estimated corrections that together have nearly the effect of one unit of it, with their values;
    /// empty if it has no effect on the measurements at all. Their estimates contain that much of it.
    pub correlated_with: Vec<(usize, f64)>,
    /// The share of its effect (root mean square) that these do not reproduce.
    pub unexplained_share: f64,
}

/// Admits the corrections one after another, the most physical first ([`CorrectionEntry`]'s order, then base to
/// tip; after an alignment base and tool before the arm), and fixes each one that would make the smallest singular value smaller than
/// `threshold` times the largest of all.
///
/// It is decided at the chain's start, so that it depends on the measured configurations and not on the measured poses, except by
/// the frames that were aligned with them.
///
/// [`CorrectionEntry`]: crate::estimation::CorrectionEntry
pub fn identify(problem: &Problem<'_>, threshold: f64) -> Identification {
    let parameters = problem.chain.parameters();
    let mut order: Vec<usize> = (0..parameters.len()).collect();
    // About frames that lie elsewhere, a correction of the arm that has the effect of a frame would be a value to write that is right
    // only together with that frame: the frame takes it.
    let have_moved = problem.chain.start().iter().any(|value| *value != 0.0);
    // A stable sort: within one kind of entry the order stays base to tip.
    order.sort_by_key(|&at| (have_moved && !parameters[at].entry.is_of_frame(), parameters[at].entry));
    let reach_m = problem.reach_m();
    let noise = Noise { position_m: 1.0, orientation_rad: 1.0 / reach_m };
    let all: Vec<usize> = (0..parameters.len()).collect();
    let CalibrationEquations { information, .. } =
        problem.normal_equations(problem.chain.start(), &all, &Weighting { noise, rows: &[] });
    let components = problem.component_count();
    identify_by_information(
        problem.chain,
        order,
        MeasuredInformation { information, components, reach_m },
        threshold,
    )
}

/// What measurements say about all corrections of a chain together.
#[derive(Debug, Clone)]
pub(crate) struct MeasuredInformation {
    /// `J^T J` in m and rad; orientations are lengths at the reach.
    pub(crate) information: DMatrix<f64>,
    /// Number of measured components.
    pub(crate) components: usize,
    /// The reach of the arm.
    pub(crate) reach_m: f64,
}

/// [`identify`] from the information alone, in an order of preference.
pub(crate) fn identify_by_information(
    chain: &CorrectedChain,
    order: Vec<usize>,
    measured: MeasuredInformation,
    threshold: f64,
) -> Identification {
    let (parameters, reach_m) = (chain.parameters(), measured.reach_m);
    let information = scaled_information(parameters, measured);
    let singular_values = singular_values(&information);
    let largest = singular_values.first().copied().unwrap_or(0.0);
    let (mut kept, mut fixed, mut kept_ratio) = (Vec::new(), Vec::new(), 1.0);
    // Greedy, because the result must be explainable: of two corrections that cannot be distinguished the more
    // physical one is estimated, whatever the singular vectors are.
    for candidate in order {
        kept.push(candidate);
        let smallest = self::singular_values(&select(&information, &kept)).last().copied().unwrap_or(0.0);
        if largest > 0.0 && smallest >= threshold * largest {
            kept_ratio = smallest / largest;
        } else {
            kept.pop();
            fixed.push(candidate);
        }
    }
    // The order of admission is no longer needed; the fits expect the order of the parameters.
    kept.sort_unstable();
    fixed.sort_unstable();
    let effect = threshold * largest;
    let in_own_units = |parameter: usize| {
        let mut fixed = relation(&information, effect, &kept, parameter);
        for (other, factor) in &mut fixed.correlated_with {
            // Factors were found in scaled units (metres at the tip); the report says them in rad and m.
            *factor *= scale(&parameters[parameter], reach_m) / scale(&parameters[*other], reach_m);
        }
        fixed
    };
    let fixed = fixed.into_iter().map(in_own_units).collect();
    Identification { kept, fixed, singular_values, kept_ratio }
}

/// Scaled units in one unit of a correction: an angle of 1 rad moves the tip by the reach.
fn scale(parameter: &CorrectionParameter, reach_m: f64) -> f64 {
    match parameter.unit() {
        ParameterUnit::Angle => reach_m,
        ParameterUnit::Length => 1.0,
    }
}

/// The mean information of a component, in scaled units.
fn scaled_information(
    parameters: &[CorrectionParameter],
    MeasuredInformation { mut information, components, reach_m }: MeasuredInformation,
) -> DMatrix<f64> {
    #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 components")]
    let components = components.max(1) as f64;
    for (row, of_row) in parameters.iter().enumerate() {
        for (column, of_column) in parameters.iter().enumerate() {
            // J^T J / components, so that the singular values do not grow with the number of measurements and one
            // threshold suits all files.
            information[(row, column)] /= components * scale(of_row, reach_m) * scale(of_column, reach_m);
        }
    }
    information
}

fn select(information: &DMatrix<f64>, kept: &[usize]) -> DMatrix<f64> {
    information.select_rows(kept).select_columns(kept)
}

/// Roots of the eigenvalues, the largest first; rounding below zero is zero.
fn singular_values(information: &DMatrix<f64>) -> Vec<f64> {
    if information.is_empty() {
        return Vec::new();
    }
    let eigenvalues = SymmetricEigen::new(information.clone()).eigenvalues;
    // Eigenvalues of J^T J are squares of the singular values of J; forming the product loses half of the digits,
    // and thresholds are far above 1e-8.
    let mut values: Vec<f64> = eigenvalues.iter().map(|value| value.max(0.0).sqrt()).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Least squares of one column of the Jacobian by the kept ones, in scaled units.
fn relation(
    information: &DMatrix<f64>,
    least_effect: f64,
    kept: &[usize],
    parameter: usize,
) -> FixedParameter {
    let effect_squared = information[(parameter, parameter)];
    let nothing = FixedParameter { parameter, correlated_with: Vec::new(), unexplained_share: 1.0 };
    // A column this small is noise for the threshold: a relation fitted to it would be one of rounding.
    if effect_squared.sqrt() < least_effect || effect_squared <= 0.0 {
        return nothing;
    }
    let Some(cholesky) = select(information, kept).cholesky() else { return nothing };
    let across = information.select_rows(kept).column(parameter).into_owned();
    // Normal equations of min | J_kept x - j |: both sides are blocks of the information matrix that is known
    // already.
    let factors = cholesky.solve(&across);
    let explained = factors.dot(&across);
    let largest = factors.amax();
    let notable = |(&other, &factor): (&usize, &f64)| {
        (factor.abs() > NEGLIGIBLE_SHARE * largest).then_some((other, factor))
    };
    FixedParameter {
        parameter,
        correlated_with: kept.iter().zip(factors.iter()).filter_map(notable).collect(),
        // | j |^2 = explained + unexplained, since the residual of least squares is orthogonal to what it
        // explains.
        unexplained_share: ((effect_squared - explained).max(0.0) / effect_squared).sqrt(),
    }
}
