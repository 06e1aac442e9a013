//! One `[[vary]]`: its keys and its distribution, checked.

use std::{fmt, ops::Range};

use congruent_input::{Diagnostic, NumberAt, Override, display::number};
use congruent_results::report::VariedValue;
use congruent_scenario::{CaseSampling, NormalSettings, VarySettings};
use serde::Serialize;

use super::{distribution::Distribution, nominal::NominalValues};
use crate::codes;

/// Keys that cannot vary, with all that is inside of them, and why.
const FIXED: [(&str, &str); 3] = [
    ("name", "it is the name of the results"),
    ("schema_version", "it is the version of the file"),
    ("uncertainty", "it says what varies"),
];

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
    /// The value of the file, if the distribution is around it.
    #[serde(skip)]
    pub(crate) nominal_value: Option<f64>,
}

impl VariedKey {
    /// Whether an override of the robot or of the scenario is of one of its keys.
    pub(super) fn has_key(&self, set: &str) -> bool {
        self.keys.iter().any(|key| key == set || key.strip_prefix("robot.") == Some(set))
    }

    /// A finding about a value that was set for one of its keys, as one about the key.
    pub(super) fn finding(&self, finding: Diagnostic) -> Diagnostic {
        about_key(&self.keys, finding)
    }
}

/// A finding about a value that was set for a key, by the key alone and without a place: nobody wrote `--set`, or that value.
fn about_key(keys: &[String], finding: Diagnostic) -> Diagnostic {
    let of_key = |key: &String| {
        let of = finding.message.strip_prefix("--set ")?;
        let of = of.strip_prefix(key.as_str()).or_else(|| of.strip_prefix(key.strip_prefix("robot.")?))?;
        let (_, rest) = of.strip_prefix('=')?.split_once(": ")?;
        Some(format!("key \"{key}\": {rest}"))
    };
    let message = keys.iter().find_map(of_key).unwrap_or_else(|| finding.message.clone());
    let help = finding.help.clone().filter(|help| !help.contains("--set") && !help.starts_with("KEY "));
    Diagnostic { message, help, span: None, source: None, ..finding }
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

/// Refuses a key that cannot vary.
pub(super) fn refuse_fixed(key: &str, fixed: &[(&str, &str)]) -> Result<(), Diagnostic> {
    match fixed.iter().find(|(fixed, _)| key == *fixed || is_inside(key, fixed)) {
        None => Ok(()),
        Some((fixed, why)) => {
            Err(Diagnostic::error(codes::sweep::KEY, format!("\"{fixed}\" cannot vary: {why}")))
        }
    }
}

/// Whether a key is one of the values under another: `start.joints_deg.elbow_joint` of `start.joints_deg`.
pub(super) fn is_inside(key: &str, outer: &str) -> bool {
    key.strip_prefix(outer).is_some_and(|rest| rest.starts_with('.'))
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
    keys.iter().try_for_each(|key| refuse_fixed(key, &FIXED))?;
    let (found, words) = if let Some(half) = relative(written).transpose()? {
        let numbers = numbers_of_file(keys, nominal)?;
        let words = match numbers.as_slice() {
            [one] => format!("{} {half}", number(one.value)),
            _ => format!("each {half}"),
        };
        (around_values(&keys[0], &half, numbers)?, words)
    } else {
        let distribution = distribution(written)?;
        let words = distribution.to_string();
        (vec![KeysWithValues { keys: keys.to_vec(), distribution, nominal_value: None }], words)
    };
    let described = VariedValue { keys: keys.to_vec(), distribution: words };
    let of = |KeysWithValues { keys, distribution, nominal_value }| {
        let steps = steps(written.steps, &distribution, sampling)?;
        let (place, described) = (place.clone(), described.clone());
        Ok(VariedKey { keys, distribution, steps, place, described, nominal_value })
    };
    found.into_iter().map(of).collect()
}

/// Keys with one value, its distribution, and the value of the file if that is around it.
struct KeysWithValues {
    keys: Vec<String>,
    distribution: Distribution,
    nominal_value: Option<f64>,
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
        Err(fault(format!("{name} = {number} is not a finite number above 0"))
            .with_help(format!("{name} = 0.5 goes both ways; remove the entry if the value does not vary")))
    })
}

/// Each number that the file has under the key.
fn numbers_of_file(keys: &[String], nominal: NominalValues<'_>) -> Result<Vec<NumberAt>, Diagnostic> {
    let [key] = keys else {
        return Err(fault("a range around the value of the file is of one key")
            .with_help("give each key a [[vary]] of its own, or all of them uniform = [a, b]"));
    };
    let key_of_zero = key_of(key, "0")?;
    let mut numbers = nominal.numbers(&key_of_zero).map_err(|fault| about_key(keys, fault))?;
    // The order of the keys of a table means nothing, so the draws must not depend on it.
    numbers.sort_by(|a, b| segments(&a.key).cmp(segments(&b.key)));
    if numbers.is_empty() {
        if let Some(unknown) = nominal.unknown_key(&key_of_zero) {
            return Err(about_key(keys, unknown));
        }
        let message = format!("the file has no number \"{key}\" for a range around it");
        return Err(Diagnostic::error(codes::sweep::KEY, message)
            .with_help("write the value into the file, or give uniform = [a, b]"));
    }
    Ok(numbers)
}

/// The parts of a key in an order that has lists by number and tables by name.
fn segments(key: &str) -> impl Iterator<Item = (Option<u64>, &str)> {
    key.split('.').map(|segment| (segment.parse().ok(), segment))
}

/// Each of these numbers of a key with a range around it.
fn around_values(
    key: &str,
    half: &HalfRange,
    numbers: Vec<NumberAt>,
) -> Result<Vec<KeysWithValues>, Diagnostic> {
    let range = |number: NumberAt| {
        let half = match *half {
            HalfRange::Absolute(half) => half,
            HalfRange::Percent(percent) => number.value.abs() * percent / 100.0,
        };
        let range = [number.value - half, number.value + half];
        (range[0] < range[1]).then(|| KeysWithValues {
            keys: vec![number.key],
            distribution: Distribution::Uniform(range),
            nominal_value: Some(number.value),
        })
    };
    let found: Vec<_> = numbers.into_iter().filter_map(range).collect();
    let is_finite = |found: &KeysWithValues| match found.distribution {
        Distribution::Uniform(range) => (range[1] - range[0]).is_finite(),
        _ => true,
    };
    if !found.iter().all(is_finite) {
        return Err(fault(format!("the range around \"{key}\" is infinitely wide")));
    }
    if found.is_empty() {
        return Err(fault(format!("\"{key}\" is 0 in the file, and a percentage of 0 is 0"))
            .with_help("plus_minus = 0.1, in the unit of the key"));
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
