//! One `[[vary]]`: its keys and its distribution, checked.

use std::ops::Range;

use congruent_input::{Diagnostic, display::number};
use congruent_results::report::VariedValue;
use congruent_scenario::{CaseSampling, VarySettings};
use serde::Serialize;

use super::{
    around::{KeysWithValues, around_values, numbers_of_file},
    distribution::Distribution,
    given::{distribution, fault, relative},
    key::{about_key, key_of, refuse_fixed},
    nominal::NominalValues,
};
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
