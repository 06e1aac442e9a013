//! The distribution of one value: from a share between 0 and 1 to the value.

use std::fmt;

use congruent_input::display::quantity_with_digits;
use serde::Serialize;

use crate::sampling::normal_quantile;

/// The distribution of a value.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Evenly between two numbers.
    Uniform([f64; 2]),
    /// Evenly between the logarithms of two positive numbers.
    LogUniform([f64; 2]),
    /// Normal, between two numbers, of which either may be infinite.
    Normal {
        /// Mean before the distribution is cut.
        mean: f64,
        /// Standard deviation before the distribution is cut.
        deviation: f64,
        /// The shares of the normal distribution below the two numbers between which it is cut.
        shares: [f64; 2],
        /// These two numbers, of which either may be infinite.
        #[serde(skip)]
        range: [f64; 2],
    },
    /// Rises to the middle one of three numbers and falls to the last.
    Triangular([f64; 3]),
    /// One of these values, as TOML, each as often.
    Values(Vec<String>),
}

impl Distribution {
    /// A normal distribution that is cut at two numbers.
    pub(super) fn normal(mean: f64, deviation: f64, [least, most]: [f64; 2]) -> Self {
        let share = |value: f64| 0.5 * libm::erfc((mean - value) / deviation / std::f64::consts::SQRT_2);
        Self::Normal { mean, deviation, shares: [share(least), share(most)], range: [least, most] }
    }

    /// The value below which a share of the distribution is, as TOML. `share` is from 0 to 1, without its ends for what is not cut.
    pub fn value(&self, share: f64) -> String {
        match self {
            Self::Values(values) => {
                #[expect(clippy::cast_precision_loss, reason = "far fewer than 2^53 values")]
                let place = share * values.len() as f64;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "from 0 to the number of values"
                )]
                let index = (place as usize).min(values.len() - 1);
                values[index].clone()
            }
            _ => number_as_toml(self.number(share)),
        }
    }

    /// Its least and its largest value, as TOML, each with one just inside of it; of single values all, twice. An end that is infinite is
    /// the value just inside.
    pub fn ends(&self) -> Vec<[String; 2]> {
        /// Share of a distribution between an end and the value inside of it.
        const INSIDE: f64 = 1e-6;
        let ends = match *self {
            Self::Values(ref values) => {
                return values.iter().map(|value| [value.clone(), value.clone()]).collect();
            }
            Self::Normal { range, .. } => range,
            _ => [0.0, 1.0].map(|share| self.number(share)),
        };
        let inside = [INSIDE, 1.0 - INSIDE].map(|share| self.number(share));
        let end = |(end, inside): (f64, f64)| {
            [if end.is_finite() { end } else { inside }, inside].map(number_as_toml)
        };
        ends.into_iter().zip(inside).map(end).collect()
    }

    /// The same of a distribution of numbers; NaN for one of values.
    fn number(&self, share: f64) -> f64 {
        match *self {
            Self::Uniform([from, to]) => from + (to - from) * share,
            Self::LogUniform([from, to]) => from * libm::exp(libm::log(to / from) * share),
            Self::Normal { mean, deviation, shares: [below, above], range: [least, most] } => {
                let value = mean + deviation * normal_quantile(below + (above - below) * share);
                value.clamp(least, most)
            }
            Self::Triangular([from, peak, to]) => {
                let rising = (peak - from) / (to - from);
                if share < rising {
                    from + (share * (to - from) * (peak - from)).sqrt()
                } else {
                    to - ((1.0 - share) * (to - from) * (to - peak)).sqrt()
                }
            }
            Self::Values(_) => f64::NAN,
        }
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Digits of a value: as many as people write.
        const DIGITS: usize = 6;
        let of = |value: f64| quantity_with_digits(value, "", DIGITS);
        match self {
            Self::Uniform([from, to]) => write!(f, "{} to {}", of(*from), of(*to)),
            Self::LogUniform([from, to]) => write!(f, "{} to {}, by its logarithm", of(*from), of(*to)),
            Self::Normal { mean, deviation, range: [least, most], .. } => {
                write!(f, "normal, {} with standard deviation {}", of(*mean), of(*deviation))?;
                if least.is_finite() {
                    write!(f, ", at least {}", of(*least))?;
                }
                if most.is_finite() { write!(f, ", at most {}", of(*most)) } else { Ok(()) }
            }
            Self::Triangular([from, peak, to]) => {
                write!(f, "{} to {}, most often {}", of(*from), of(*to), of(*peak))
            }
            Self::Values(values) => write!(f, "one of {}", values.join(", ")),
        }
    }
}

/// A number with the digits that give it back, always as a float: `2.0`.
fn number_as_toml(number: f64) -> String {
    format!("{number:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn is_at(distribution: &Distribution, share: f64, value: f64) {
        let found: f64 = distribution.value(share).parse().unwrap();
        assert!((found - value).abs() <= 1e-12 * value.abs().max(1.0), "{found} for {value}");
    }

    #[test]
    fn shares_of_each_distribution() {
        is_at(&Distribution::Uniform([1.0, 3.0]), 0.25, 1.5);
        is_at(&Distribution::LogUniform([1.0, 100.0]), 0.5, 10.0);
        is_at(&Distribution::Triangular([0.0, 1.0, 3.0]), 1.0 / 3.0, 1.0);
        is_at(&Distribution::Triangular([0.0, 1.0, 3.0]), 1.0, 3.0);
        let open = Distribution::normal(2.0, 0.5, [f64::NEG_INFINITY, f64::INFINITY]);
        is_at(&open, 0.5, 2.0);
        // 0.975 is 1.96 standard deviations.
        is_at(&open, 0.975, 2.0 + 0.5 * 1.959_963_984_540_054);
        let cut = Distribution::normal(2.0, 0.5, [2.0, f64::INFINITY]);
        is_at(&cut, 0.95, 2.0 + 0.5 * 1.959_963_984_540_054);
        assert_eq!(Distribution::Values(vec!["1".into(), "\"b\"".into()]).value(0.6), "\"b\"");
        assert_eq!(Distribution::Values(vec!["1".into(), "\"b\"".into()]).value(1.0), "\"b\"");
    }
}
