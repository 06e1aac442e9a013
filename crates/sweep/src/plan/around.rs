//! Ranges around the values that a file has.

use congruent_input::{Diagnostic, NumberAt};

use super::{
    distribution::Distribution,
    given::{HalfRange, fault},
    key::{about_key, key_of},
    nominal::NominalValues,
};
use crate::codes;

/// Keys with one value, its distribution, and the value of the file if that is around it.
pub(super) struct KeysWithValues {
    pub(super) keys: Vec<String>,
    pub(super) distribution: Distribution,
    pub(super) nominal_value: Option<f64>,
}

/// Each number that the file has under the key.
pub(super) fn numbers_of_file(
    keys: &[String],
    nominal: NominalValues<'_>,
) -> Result<Vec<NumberAt>, Diagnostic> {
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
pub(super) fn around_values(
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
