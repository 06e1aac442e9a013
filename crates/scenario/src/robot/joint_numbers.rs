//! A number for all joints, or numbers by joint.

use std::{collections::BTreeMap, fmt};

use schemars::JsonSchema;
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{MapAccess, Visitor},
};

/// The entry of a table by joint that holds for all joints that are not named.
pub const OTHERS: &str = "others";

/// One number for all joints, or a table of numbers by joint; in a table, `others` holds for the joints that it does
/// not name.
///
/// # Examples
/// ```
/// use congruent_scenario::JointNumbers;
/// let same = JointNumbers::from(400.0);
/// let stiffer_base = JointNumbers::from([("shoulder_pan_joint", 4000.0), ("others", 400.0)]);
/// assert_ne!(same, stiffer_base);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum JointNumbers {
    /// The same for all joints.
    All(f64),
    /// A number for each named joint.
    ByJoint(BTreeMap<String, f64>),
}

impl Default for JointNumbers {
    fn default() -> Self {
        Self::All(0.0)
    }
}

impl From<f64> for JointNumbers {
    fn from(number: f64) -> Self {
        Self::All(number)
    }
}

impl<const N: usize> From<[(&str, f64); N]> for JointNumbers {
    fn from(numbers: [(&str, f64); N]) -> Self {
        Self::ByJoint(numbers.map(|(joint, number)| (joint.to_owned(), number)).into())
    }
}

impl JointNumbers {
    /// Whether no joint has a number other than zero.
    pub fn is_zero(&self) -> bool {
        let zero = |number: &f64| number.to_bits() << 1 == 0;
        match self {
            Self::All(number) => zero(number),
            Self::ByJoint(numbers) => numbers.values().all(zero),
        }
    }
}

impl<'de> Deserialize<'de> for JointNumbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumbersVisitor)
    }
}

struct NumbersVisitor;

impl<'de> Visitor<'de> for NumbersVisitor {
    type Value = JointNumbers;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a table of numbers by joint")
    }

    fn visit_f64<E>(self, number: f64) -> Result<JointNumbers, E> {
        Ok(JointNumbers::All(number))
    }

    #[expect(clippy::cast_precision_loss, reason = "a gain of more than 2^53 is out of reach all the same")]
    fn visit_i64<E>(self, number: i64) -> Result<JointNumbers, E> {
        Ok(JointNumbers::All(number as f64))
    }

    #[expect(clippy::cast_precision_loss, reason = "as above")]
    fn visit_u64<E>(self, number: u64) -> Result<JointNumbers, E> {
        Ok(JointNumbers::All(number as f64))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<JointNumbers, A::Error> {
        let mut numbers = BTreeMap::new();
        while let Some((joint, number)) = map.next_entry()? {
            numbers.insert(joint, number);
        }
        Ok(JointNumbers::ByJoint(numbers))
    }
}
