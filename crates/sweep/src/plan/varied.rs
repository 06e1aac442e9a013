//! One `[[vary]]`: its keys and its distribution, checked.

use std::ops::Range;

use congruent_input::{Diagnostic, Override};
use serde::Serialize;
use toml::Spanned;

use super::{
    distribution::Distribution,
    written::{WrittenNormal, WrittenVary},
};
use crate::{codes, sampling::CaseSampling};

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

pub(super) fn varied(vary: &Spanned<WrittenVary>, sampling: CaseSampling) -> Result<VariedKey, Diagnostic> {
    let written = vary.get_ref();
    let keys = written.keys().ok_or_else(|| {
        let message = format!("key = {} is no key and no list of keys", written.key.get_ref());
        Diagnostic::error(codes::sweep::KEY, message).with_help("key = \"controller.stiffness\"")
    })?;
    keys.iter().try_for_each(|key| key_of(key, "0").map(|_| ()))?;
    if keys.iter().any(|key| key == NAME) {
        return Err(Diagnostic::error(
            codes::sweep::KEY,
            "the name of the scenario is that of its results, and cannot vary",
        ));
    }
    let distribution = distribution(written)?;
    let steps = steps(written, &distribution, sampling)?;
    Ok(VariedKey { keys, distribution, steps, place: vary.span() })
}

fn fault(message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(codes::sweep::DISTRIBUTION, message.into())
}

/// The one distribution that is given.
fn distribution(written: &WrittenVary) -> Result<Distribution, Diagnostic> {
    let given: Vec<Result<Distribution, Diagnostic>> = [
        written.uniform.as_ref().map(|range| {
            let range = *range.get_ref();
            ascending(&range).map(|()| Distribution::Uniform(range))
        }),
        written.log_uniform.as_ref().map(|range| {
            let range = *range.get_ref();
            ascending(&range)?;
            if range[0] <= 0.0 {
                return Err(fault(format!("log_uniform = {range:?} is not above 0")));
            }
            Ok(Distribution::LogUniform(range))
        }),
        written.normal.map(normal),
        written.triangular.as_ref().map(|corners| triangular(*corners.get_ref())),
        written.values.as_ref().map(|values| {
            if values.is_empty() {
                return Err(fault("values = [] has no value"));
            }
            Ok(Distribution::Values(values.iter().map(ToString::to_string).collect()))
        }),
    ]
    .into_iter()
    .flatten()
    .collect();
    let count = given.len();
    match given.into_iter().next() {
        Some(one) if count == 1 => one,
        _ => Err(fault(format!("{count} distributions are given, expected one"))
            .with_help("one of uniform = [0.5, 3.0], log_uniform, normal = { mean = 2.0, deviation = 0.5 }, triangular, values")),
    }
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

fn normal(of: WrittenNormal) -> Result<Distribution, Diagnostic> {
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
    written: &WrittenVary,
    distribution: &Distribution,
    sampling: CaseSampling,
) -> Result<u64, Diagnostic> {
    if sampling != CaseSampling::Grid {
        return match written.steps {
            Some(_) => Err(fault("steps is of sampling = \"grid\" alone")),
            None => Ok(1),
        };
    }
    match (distribution, written.steps) {
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
