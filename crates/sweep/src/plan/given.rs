//! The distribution that an entry gives, checked.

use std::fmt;

use congruent_input::{Diagnostic, display::number};
use congruent_scenario::{NormalSettings, VarySettings};

use super::distribution::Distribution;
use crate::codes;

/// Half of a range around a value of the file.
pub(super) enum HalfRange {
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
pub(super) fn relative(written: &VarySettings) -> Option<Result<HalfRange, Diagnostic>> {
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
        Err(fault(format!("{name} = {number} is not a finite number above 0"))
            .with_help(format!("{name} = 0.5 goes both ways; remove the entry if the value does not vary")))
    })
}

pub(super) fn fault(message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(codes::sweep::DISTRIBUTION, message.into())
}

/// The one distribution that is given.
pub(super) fn distribution(written: &VarySettings) -> Result<Distribution, Diagnostic> {
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
    let is_finite =
        numbers.first().zip(numbers.last()).is_some_and(|(first, last)| (last - first).is_finite());
    if is_ascending && is_finite {
        Ok(())
    } else {
        Err(fault(format!("{numbers:?} are not two finite numbers of which the second is larger"))
            .with_help("uniform = [0.5, 3.0]; a value that does not vary needs no entry"))
    }
}

fn triangular(corners: [f64; 3]) -> Result<Distribution, Diagnostic> {
    let [from, peak, to] = corners;
    // The peak may be at an end.
    if from < to && from <= peak && peak <= to && (to - from).is_finite() {
        return Ok(Distribution::Triangular(corners));
    }
    Err(fault(format!("triangular = {corners:?} is not least, most frequent and largest value"))
        .with_help("triangular = [0.5, 2.0, 3.0]"))
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
