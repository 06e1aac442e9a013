//! One `[[vary]]`: its keys and its distribution, checked.

use std::{fmt, ops::Range};

use congruent_input::{Diagnostic, NumberAt, Override, display::number};
use congruent_results::report::VariedValue;
use congruent_scenario::{CaseSampling, NormalSettings, VarySettings};
use serde::Serialize;

use super::{distribution::Distribution, nominal::NominalValues};
use crate::codes;

/// The key of the scenario's name.
const NAME: &str = "name";

/// Keys that get one value, and its distribution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariedKey {
    /// The keys, as of --set; the first names the column of the table.
    pub keys: Vec<String>,
    /// The distribution of the value.
    pub distribution: Distribution,
    /// Number of values on a grid; 1 otherwise.
    pub steps: u64,
    /// Its `[[vary]]` in the plan file.
    #[serde(skip)]
    pub(super) place: Range<usize>,
    /// What that says, in words.
    #[serde(skip)]
    pub(super) described: VariedValue,
}

/// A key with a value, as of --set.
pub(super) fn key_of(key: &str, value: &str) -> Result<Override, Diagnostic> {
    format!("{key}={value}").parse().map_err(|fault: Diagnostic| {
        let message = format!("\"{key}\" is no key of a scenario: {}", fault.message);
        Diagnostic::error(codes::sweep::KEY, message).with_help(
            "join the keys of the file by dots; an entry of a list has its number, from 1: payload.1.mass_kg",
        )
    })
}

/// The keys that one `[[vary]]` varies: one entry, or, relative to a list or table of the file, one for each of its numbers.
pub(super) fn varied(
    written: &VarySettings,
    place: &Range<usize>,
    sampling: CaseSampling,
    nominal: NominalValues<'_>,
) -> Result<Vec<VariedKey>, Diagnostic> {
    let keys = written.key.as_slice();
    if keys.is_empty() {
        let fault = Diagnostic::error(codes::sweep::KEY, "key = [] has no key");
        return Err(fault.with_help("key = \"controller.stiffness\""));
    }
    keys.iter().try_for_each(|key| key_of(key, "0").map(|_| ()))?;
    if keys.iter().any(|key| key == NAME) {
        return Err(Diagnostic::error(
            codes::sweep::KEY,
            "the name of the scenario is that of its results, and cannot vary",
        ));
    }
    let (found, distribution) = if let Some(half) = relative(written).transpose()? {
        (around_values(keys, &half, nominal)?, half.to_string())
    } else {
        let distribution = distribution(written)?;
        let words = distribution.to_string();
        (vec![(keys.to_vec(), distribution)], words)
    };
    let described = VariedValue { keys: keys.to_vec(), distribution };
    let of = |(keys, distribution): (Vec<String>, Distribution)| {
        let steps = steps(written.steps, &distribution, sampling)?;
        Ok(VariedKey { keys, distribution, steps, place: place.clone(), described: described.clone() })
    };
    found.into_iter().map(of).collect()
}

/// Half of a range around a value of the file.
enum HalfRange {
    Absolute(f64),
    Percent(f64),
}

impl fmt::Display for HalfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Absolute(half) => write!(f, "+- {}", number(*half)),
            Self::Percent(percent) => write!(f, "+- {} %", number(*percent)),
        }
    }
}

/// The range around the values of the file, if it is given.
fn relative(written: &VarySettings) -> Option<Result<HalfRange, Diagnostic>> {
    let (name, number, half) = match (written.plus_minus, written.percent) {
        (None, None) => return None,
        (Some(number), None) => ("plus_minus", number, HalfRange::Absolute(number)),
        (None, Some(number)) => ("percent", number, HalfRange::Percent(number)),
        (Some(_), Some(_)) => return Some(Err(several(2 + absolute(written).len()))),
    };
    let others = absolute(written).len();
    if others > 0 {
        return Some(Err(several(1 + others)));
    }
    let is_range = number.is_finite() && number > 0.0;
    Some(if is_range {
        Ok(half)
    } else {
        Err(fault(format!("{name} = {number} is not a finite number above 0")))
    })
}

/// Each number that the file has under the key, with a range around it.
fn around_values(
    keys: &[String],
    half: &HalfRange,
    nominal: NominalValues<'_>,
) -> Result<Vec<(Vec<String>, Distribution)>, Diagnostic> {
    let [key] = keys else {
        return Err(fault("a range around the value of the file is of one key")
            .with_help("give each key a [[vary]] of its own, or all of them uniform = [a, b]"));
    };
    let numbers = nominal.numbers(&key_of(key, "0")?)?;
    if numbers.is_empty() {
        let message = format!("the file has no value \"{key}\" for a range around it");
        return Err(Diagnostic::error(codes::sweep::KEY, message)
            .with_help("write the value into the file, or give uniform = [a, b]"));
    }
    let range = |number: NumberAt| {
        let half = match *half {
            HalfRange::Absolute(half) => half,
            HalfRange::Percent(percent) => number.value.abs() * percent / 100.0,
        };
        let range = [number.value - half, number.value + half];
        (range[0] < range[1]).then(|| (vec![number.key], Distribution::Uniform(range)))
    };
    let found: Vec<_> = numbers.into_iter().filter_map(range).collect();
    if found.is_empty() {
        return Err(fault(format!("\"{key}\" is 0 in the file, of which no percentage is a range"))
            .with_help("plus_minus = 0.1"));
    }
    Ok(found)
}

fn fault(message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(codes::sweep::DISTRIBUTION, message.into())
}

/// The one distribution that is given.
fn distribution(written: &VarySettings) -> Result<Distribution, Diagnostic> {
    let given = absolute(written);
    let count = given.len();
    match given.into_iter().next() {
        Some(one) if count == 1 => one,
        _ => Err(several(count)),
    }
}

fn several(count: usize) -> Diagnostic {
    fault(format!("{count} distributions are given, expected one"))
        .with_help("one of uniform = [0.5, 3.0], log_uniform, normal = { mean = 2.0, deviation = 0.5 }, triangular, values, plus_minus = 0.5, percent = 20.0")
}

/// Every distribution that is given by its values.
fn absolute(written: &VarySettings) -> Vec<Result<Distribution, Diagnostic>> {
    let uniform = written.uniform.map(|range| ascending(&range).map(|()| Distribution::Uniform(range)));
    let log_uniform = written.log_uniform.map(|range| {
        ascending(&range)?;
        if range[0] <= 0.0 {
            return Err(fault(format!("log_uniform = {range:?} is not above 0")));
        }
        Ok(Distribution::LogUniform(range))
    });
    let values = written.values.as_ref().map(|values| {
        if values.is_empty() {
            return Err(fault("values = [] has no value"));
        }
        Ok(Distribution::Values(values.iter().map(ToString::to_string).collect()))
    });
    let others = [written.normal.map(normal), written.triangular.map(triangular), values];
    [uniform, log_uniform].into_iter().chain(others).flatten().collect()
}

fn ascending(numbers: &[f64]) -> Result<(), Diagnostic> {
    let is_ascending = numbers.is_sorted_by(|a, b| a < b) && numbers.iter().all(|number| number.is_finite());
    if is_ascending {
        Ok(())
    } else {
        Err(fault(format!("{numbers:?} are not two finite numbers in ascending order"))
            .with_help("write the smaller one first"))
    }
}

fn triangular(corners: [f64; 3]) -> Result<Distribution, Diagnostic> {
    let [from, peak, to] = corners;
    // The peak may be at an end.
    if from < to && from <= peak && peak <= to && from.is_finite() && to.is_finite() {
        return Ok(Distribution::Triangular(corners));
    }
    Err(fault(format!("triangular = {corners:?} is no first value, most frequent value and last value")))
}

fn normal(of: NormalSettings) -> Result<Distribution, Diagnostic> {
    let range = [of.min.unwrap_or(f64::NEG_INFINITY), of.max.unwrap_or(f64::INFINITY)];
    if !(of.mean.is_finite() && of.deviation.is_finite() && of.deviation > 0.0) {
        return Err(fault("a normal distribution needs a finite mean and a deviation above 0"));
    }
    let distribution = Distribution::normal(of.mean, of.deviation, range);
    // Further out the shares have no digits.
    let is_cut_empty = match &distribution {
        Distribution::Normal { shares: [below, above], .. } => {
            above - below <= 1e-9 || (above - below).is_nan()
        }
        _ => false,
    };
    if is_cut_empty {
        return Err(fault(format!(
            "between {} and {} there is nothing of the distribution",
            range[0], range[1]
        )));
    }
    Ok(distribution)
}

/// Number of values on a grid; 1 for other samplings.
fn steps(
    written: Option<u32>,
    distribution: &Distribution,
    sampling: CaseSampling,
) -> Result<u64, Diagnostic> {
    if sampling != CaseSampling::Grid {
        return match written {
            Some(_) => Err(fault("steps is of sampling = \"grid\" alone")),
            None => Ok(1),
        };
    }
    match (distribution, written) {
        (Distribution::Values(values), None) => Ok(values.len() as u64),
        (Distribution::Values(_), Some(_)) => Err(fault("steps beside values: the values are the steps")),
        (Distribution::Uniform(_) | Distribution::LogUniform(_), Some(steps)) if steps > 1 => {
            Ok(steps.into())
        }
        (Distribution::Uniform(_) | Distribution::LogUniform(_), _) => {
            Err(fault("a range on a grid needs steps, at least 2").with_help("steps = 5"))
        }
        _ => Err(fault("a grid has values, or ranges with steps")
            .with_help("sampling = \"latin_hypercube\" takes every distribution")),
    }
}
