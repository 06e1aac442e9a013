//! Quantiles of the length of a normal vector with a given covariance, and of mixtures of such vectors.
//!
//! In the axes of the covariance, with variances `s`, the vector is `(sqrt(s_i) rho u_i)`, `u` uniform on the sphere and `rho` the
//! length of a standard normal vector. So `P(length <= r)` is the mean over the sphere of `F(r / sqrt(sum s_i u_i^2))` with
//! `F(t) = erf(t / sqrt 2) - sqrt(2 / pi) t exp(-t^2 / 2)`, the distribution of `rho`: a smooth function on an octant, which
//! a product rule integrates. No draw, no table.
//!
//! Source: Ruben, *Probability content of regions under spherical normal distributions* (1962), for the distribution.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, SQRT_2};

use nalgebra::Matrix3;

/// Points along z (Gauss-Legendre) and about it (midpoints, exact for periodic functions). The error of a probability is below 1e-6
/// for any variances; see the tests.
const ALONG: u32 = 12;
const ABOUT: u32 = 8;
/// Last change of a quantile, relative. Kind: solver stop.
const RELATIVE: f64 = 1e-7;
/// Last difference of a probability. Kind: solver stop.
const CLOSE: f64 = 1e-8;
/// Most steps of the search for a quantile.
const MOST_STEPS: u32 = 80;

/// The variances of a vector along its principal axes, the largest last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PrincipalVariances(pub(crate) [f64; 3]);

impl PrincipalVariances {
    /// Of a covariance.
    pub(crate) fn new(covariance: &Matrix3<f64>) -> Self {
        let found = covariance.symmetric_eigenvalues();
        let mut variances = [found.x.max(0.0), found.y.max(0.0), found.z.max(0.0)];
        variances.sort_by(f64::total_cmp);
        Self(variances)
    }
}

/// Up to which length of a standard normal vector its distribution is tabulated; beyond it 1 - F is below 1e-30.
const LONGEST: f64 = 12.0;
/// Intervals of the table. Kind: truncation; cubic interpolation with exact slopes is off by less than 1e-12.
const INTERVALS: u32 = 4096;

/// Directions of an octant with weights, and the distribution of the length of a standard normal vector.
#[derive(Debug, Clone)]
pub(crate) struct NormDistribution {
    /// `F(t)` and its slope times the interval, at each end of an interval: a search for a quantile needs millions of values.
    table: Vec<[f64; 2]>,
    /// Squares of the coordinates, and the weight.
    nodes: Vec<([f64; 3], f64)>,
}

impl NormDistribution {
    /// The nodes of the product rule.
    pub(crate) fn new() -> Self {
        let mut nodes = Vec::new();
        for (z, along) in legendre(ALONG) {
            // From -1..1 to 0..1.
            let (z, along) = (f64::midpoint(z, 1.0), along / 2.0);
            for k in 0..ABOUT {
                let (sine, cosine) = libm::sincos(FRAC_PI_2 * (f64::from(k) + 0.5) / f64::from(ABOUT));
                let across = 1.0 - z * z;
                nodes.push((
                    [across * cosine * cosine, across * sine * sine, z * z],
                    along / f64::from(ABOUT),
                ));
            }
        }
        let interval = LONGEST / f64::from(INTERVALS);
        let end = |k: u32| {
            let t = f64::from(k) * interval;
            [within(t), FRAC_2_PI.sqrt() * t * t * libm::exp(-t * t / 2.0) * interval]
        };
        Self { nodes, table: (0..=INTERVALS).map(end).collect() }
    }

    /// `F(t)`, by cubic Hermite interpolation.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below the number of intervals"
    )]
    fn within(&self, t: f64) -> f64 {
        let place = t * (f64::from(INTERVALS) / LONGEST);
        let at = place as usize;
        let Some([[low, low_slope], [high, high_slope]]) =
            self.table.get(at..at + 2).and_then(<[_]>::as_array)
        else {
            return 1.0;
        };
        let s = place - place.floor();
        let bend = high - low;
        low + s
            * (low_slope
                + s * (3.0 * bend - 2.0 * low_slope - high_slope + s * (low_slope + high_slope - 2.0 * bend)))
    }

    /// Probability that the length is at most `r`.
    fn probability(&self, PrincipalVariances(s): &PrincipalVariances, r: f64) -> f64 {
        let node = |(u, weight): &([f64; 3], f64)| {
            let deviation = (s[0] * u[0] + s[1] * u[1] + s[2] * u[2]).sqrt();
            // Nothing varies in this direction: surely within r.
            if deviation > 0.0 { weight * self.within(r / deviation) } else { *weight }
        };
        self.nodes.iter().map(node).sum()
    }

    /// Probability that the length of a vector of a mixture is at most `r`, each part as likely as the others.
    pub(crate) fn mean_probability(&self, parts: &[PrincipalVariances], r: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^52 configurations")]
        let count = parts.len().max(1) as f64;
        parts.iter().map(|part| self.probability(part, r)).sum::<f64>() / count
    }

    /// The length that a vector of a mixture does not exceed with this probability.
    pub(crate) fn quantile(&self, parts: &[PrincipalVariances], probability: f64) -> f64 {
        let largest = parts.iter().map(|PrincipalVariances(s)| s.iter().sum::<f64>()).fold(0.0, f64::max);
        if largest == 0.0 {
            return 0.0;
        }
        // Twelve standard deviations hold more than any probability that is asked for in 64 bits.
        let whole = QuantileBracket {
            low: 0.0,
            below: -probability,
            high: 12.0 * largest.sqrt(),
            above: 1.0 - probability,
        };
        self.root(parts, probability, whole)
    }

    /// The same, if it is probably near `guess`, which saves half of the work.
    pub(crate) fn quantile_near(&self, parts: &[PrincipalVariances], probability: f64, guess: f64) -> f64 {
        let excess = |r: f64| self.mean_probability(parts, r) - probability;
        let (low, high) = (0.97 * guess, 1.03 * guess);
        let (below, above) = (excess(low), excess(high));
        if guess > 0.0 && below < 0.0 && above > 0.0 {
            self.root(parts, probability, QuantileBracket { low, below, high, above })
        } else {
            self.quantile(parts, probability)
        }
    }

    /// Regula falsi with the Illinois correction: the distribution is monotone, and flat at both ends.
    fn root(&self, parts: &[PrincipalVariances], probability: f64, within: QuantileBracket) -> f64 {
        let QuantileBracket { mut low, mut below, mut high, mut above } = within;
        for _ in 0..MOST_STEPS {
            let r = high - above * (high - low) / (above - below);
            let found = self.mean_probability(parts, r) - probability;
            if found.abs() < CLOSE || high - low < RELATIVE * high {
                return r;
            }
            if found > 0.0 {
                (high, above) = (r, found);
                below /= 2.0;
            } else {
                (low, below) = (r, found);
                above /= 2.0;
            }
        }
        f64::midpoint(low, high)
    }
}

/// Two lengths, and by how much their probabilities are below and above the one that is wanted.
#[derive(Debug, Clone, Copy)]
struct QuantileBracket {
    low: f64,
    below: f64,
    high: f64,
    above: f64,
}

/// Probability that a standard normal vector of three components is no longer than `t`.
fn within(t: f64) -> f64 {
    libm::erf(t / SQRT_2) - FRAC_2_PI.sqrt() * t * libm::exp(-t * t / 2.0)
}

/// Nodes in -1..1 and weights of the Gauss-Legendre rule.
///
/// Source: Press et al., *Numerical Recipes* (2007), section 4.6.1.
fn legendre(n: u32) -> Vec<(f64, f64)> {
    let count = f64::from(n);
    let node = |k: u32| {
        let mut x = libm::cos(PI * (f64::from(k) + 0.75) / (count + 0.5));
        let mut slope = 1.0;
        // Newton from this start converges within five steps to rounding.
        for _ in 0..8 {
            let (mut p, mut p_before) = (1.0, 0.0);
            for j in 0..n {
                let j = f64::from(j);
                (p, p_before) = (((2.0 * j + 1.0) * x * p - j * p_before) / (j + 1.0), p);
            }
            slope = count * (x * p - p_before) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error of the product rule, relative in the length; worst seen 2e-6, x3.
    const QUADRATURE: f64 = 6e-6;

    #[track_caller]
    fn assert_quantile(variances: [f64; 3], probability: f64, expected: f64) {
        let found = NormDistribution::new().quantile(&[PrincipalVariances(variances)], probability);
        assert!((found / expected - 1.0).abs() < QUADRATURE, "{found} for {expected}");
    }

    /// From tables of the normal and the chi-squared distribution with 2 and 3 degrees of freedom: sqrt of 3.841459, 5.991465,
    /// 7.814728 at 95 %, and -2 ln(1 - p) is the closed form for two.
    #[test]
    fn lengths_of_tables() {
        assert_quantile([0.0, 0.0, 1.0], 0.95, 1.959_964);
        assert_quantile([0.0, 1.0, 1.0], 0.95, 2.447_747);
        assert_quantile([1.0, 1.0, 1.0], 0.95, 2.795_483);
        assert_quantile([0.0, 4.0, 4.0], 0.997, 2.0 * (-2.0 * 0.003_f64.ln()).sqrt());
        assert_quantile([0.0, 0.0, 4.0], 0.997, 2.0 * 2.967_738);
    }

    #[test]
    fn a_mixture_is_between_its_parts() {
        let parts = [PrincipalVariances([0.0, 0.0, 1.0]), PrincipalVariances([0.0, 0.0, 4.0])];
        let found = NormDistribution::new().quantile(&parts, 0.95);
        // P = (erf(r / sqrt 2) + erf(r / (2 sqrt 2))) / 2 at the length that was found.
        let probability = f64::midpoint(libm::erf(found / SQRT_2), libm::erf(found / (2.0 * SQRT_2)));
        assert!((probability - 0.95).abs() < 1e-5, "{probability}");
    }

    #[test]
    fn what_does_not_vary_has_length_0() {
        let found = NormDistribution::new().quantile(&[PrincipalVariances([0.0; 3])], 0.997);
        assert_eq!(found.to_bits(), 0.0_f64.to_bits());
    }
}
