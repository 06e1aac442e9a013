//! Which parameter to tighten: its share in the variance, what each micrometre buys, and what halving buys.

use congruent_calibration::estimation::ParameterUnit;
use schemars::JsonSchema;
use serde::Serialize;

use crate::{
    first_order::ScaledColumns,
    norm_quantile::{NormDistribution, PrincipalVariances},
    parameters::ToleratedChain,
};

/// By how much a tolerance is changed to find what a small change buys, relative.
const STEP: f64 = 0.01;
/// Configurations at which the ranking is computed, at most. Kind: speed; the shares change by a few percent from set to set.
const MOST_CONFIGURATIONS: usize = 500;
/// How many halvings are listed.
const HALVINGS: usize = 5;

/// One parameter, its tolerance and its part in the error.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ParameterShare {
    /// `<joint>.<entry>`, `base.<axis>` or `tcp.<axis>`.
    pub name: String,
    /// Unit of the tolerance.
    pub unit: ParameterUnit,
    /// Half width, in `unit`.
    pub tolerance: f64,
    /// Standard deviation, in `unit`.
    pub standard_deviation: f64,
    /// Share of the variance of the position over the configurations; all add up to 1.
    pub share: f64,
    /// By how much the 95 % error falls, to first order, for each micrometre or 0.001 degree of a tighter tolerance, m.
    pub gain_per_step_m: f64,
    /// The 95 % error if this tolerance alone is halved, m.
    pub p95_if_halved_m: f64,
    /// Its error in the worst case that is attained, in `unit`.
    pub worst_case_error: f64,
}

/// A tolerance that is halved after those before it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Halving {
    /// Name of the parameter.
    pub parameter: String,
    /// Unit of the tolerance.
    pub unit: ParameterUnit,
    /// The halved tolerance, in `unit`.
    pub tolerance: f64,
    /// The 95 % error then, m.
    pub p95_m: f64,
}

/// Which parameter to tighten.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TighteningOrder {
    /// The parameter that is worth most first.
    pub(crate) parameters: Vec<ParameterShare>,
    /// One halving after the other, each where it buys most.
    pub(crate) halvings: Vec<Halving>,
}

/// One micrometre, or a thousandth of a degree.
fn step(unit: ParameterUnit) -> f64 {
    match unit {
        ParameterUnit::Length => 1e-6,
        ParameterUnit::Angle => 1e-3_f64.to_radians(),
    }
}

/// Ranks the parameters by their share of the variance of the position; `p95_m` is the 95 % error over all configurations.
pub(crate) fn tightening_order(
    tolerated: &ToleratedChain,
    columns: &ScaledColumns,
    norm: &NormDistribution,
    worst_errors: &[f64],
    p95_m: f64,
) -> TighteningOrder {
    let columns = columns.thinned(MOST_CONFIGURATIONS);
    let parts = columns.parts_m2(tolerated);
    let total: f64 = parts.iter().sum();
    let thinned = Percentile95::new(tolerated, &columns, norm);
    // The configurations of the ranking may be a part of all: ratios are taken there, and values from all.
    let of_all = if thinned.p95_m > 0.0 { p95_m / thinned.p95_m } else { 1.0 };
    let share = |(at, part): (usize, &f64)| {
        let (parameter, tolerance) = (&tolerated.parameters[at], tolerated.spread.tolerances[at]);
        let mut factors = vec![1.0; parts.len()];
        factors[at] = 0.5;
        let halved_m = thinned.with_factors(&factors);
        ParameterShare {
            name: parameter.name.clone(),
            unit: parameter.unit,
            tolerance,
            standard_deviation: tolerated.spread.deviations[at],
            share: if total > 0.0 { part / total } else { 0.0 },
            gain_per_step_m: of_all * thinned.slope_m(at) / tolerance * step(parameter.unit),
            p95_if_halved_m: of_all * halved_m,
            worst_case_error: worst_errors[at],
        }
    };
    let mut parameters: Vec<ParameterShare> = parts.iter().enumerate().map(share).collect();
    // Stable: equal shares keep the order of the chain.
    parameters.sort_by(|a, b| b.share.total_cmp(&a.share));
    TighteningOrder { parameters, halvings: halvings(&thinned, of_all) }
}

/// The 95 % error over configurations, and how it changes with the tolerances.
struct Percentile95<'a> {
    tolerated: &'a ToleratedChain,
    columns: &'a ScaledColumns,
    norm: &'a NormDistribution,
    p95_m: f64,
    /// Change of the probability by m at that length.
    density: f64,
}

impl<'a> Percentile95<'a> {
    fn new(tolerated: &'a ToleratedChain, columns: &'a ScaledColumns, norm: &'a NormDistribution) -> Self {
        let variances = columns.position_variances(tolerated);
        let p95_m = norm.quantile(&variances, 0.95);
        let [below, above] =
            [1.0 - STEP, 1.0 + STEP].map(|factor| norm.mean_probability(&variances, factor * p95_m));
        let density = if p95_m > 0.0 { (above - below) / (2.0 * STEP * p95_m) } else { 0.0 };
        Self { tolerated, columns, norm, p95_m, density }
    }

    /// With the standard deviation of each parameter multiplied, m.
    fn with_factors(&self, factors: &[f64]) -> f64 {
        let variances = self.columns.scaled(factors).position_variances(self.tolerated);
        let square = |PrincipalVariances(s): &PrincipalVariances| s.iter().sum::<f64>();
        let [before, now] = [&self.columns.position_variances(self.tolerated), &variances]
            .map(|of| of.iter().map(square).sum::<f64>());
        // The quantile follows the root mean square within a few percent.
        let guess = if before > 0.0 { self.p95_m * (now / before).sqrt() } else { 0.0 };
        self.norm.quantile_near(&variances, 0.95, guess)
    }

    /// Change of the 95 % error by the relative change of one tolerance, m.
    ///
    /// `P(r, f) = 0.95` with `f` the factor of the tolerance: `dr/df = -(dP/df) / (dP/dr)`, both by differences over both sides.
    fn slope_m(&self, parameter: usize) -> f64 {
        let probability = |factor: f64| {
            let mut factors = vec![1.0; self.tolerated.parameters.len()];
            factors[parameter] = factor;
            let variances = self.columns.scaled(&factors).position_variances(self.tolerated);
            self.norm.mean_probability(&variances, self.p95_m)
        };
        let change = probability(1.0 + STEP) - probability(1.0 - STEP);
        if self.density > 0.0 { -change / (2.0 * STEP * self.density) } else { 0.0 }
    }
}

/// One halving after another; `of_all` makes of a value over the configurations here one over all.
fn halvings(of: &Percentile95<'_>, of_all: f64) -> Vec<Halving> {
    let tolerated = of.tolerated;
    let mut factors = vec![1.0; tolerated.parameters.len()];
    let mut listed = Vec::new();
    for _ in 0..HALVINGS {
        let parts = of.columns.scaled(&factors).parts_m2(tolerated);
        let largest = parts.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        let Some((at, _)) = largest.filter(|(_, part)| **part > 0.0) else { break };
        factors[at] /= 2.0;
        listed.push(Halving {
            parameter: tolerated.parameters[at].name.clone(),
            unit: tolerated.parameters[at].unit,
            tolerance: tolerated.spread.tolerances[at] * factors[at],
            p95_m: of_all * of.with_factors(&factors),
        });
    }
    listed
}
