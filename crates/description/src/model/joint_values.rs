//! Values by joint name, in the order of the joints.

use serde::{Serialize, Serializer};

/// One value for each joint, base to tip; a map in JSON.
///
/// # Examples
/// ```
/// use congruent_description::ByJoint;
/// let names = ["shoulder".to_owned(), "elbow".to_owned()];
/// let q = ByJoint::new(&names, &[0.25, 1.5]);
/// assert_eq!(q.listed(2), "shoulder 0.25, elbow 1.50");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ByJoint(Vec<(String, f64)>);

impl ByJoint {
    /// Pairs names with values, in rad or m.
    pub fn new(names: &[String], values: &[f64]) -> Self {
        Self(names.iter().cloned().zip(values.iter().copied()).collect())
    }

    /// Joints and values, base to tip.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(name, value)| (name.as_str(), *value))
    }

    /// All of them in one line, with this number of decimals.
    pub fn listed(&self, decimals: usize) -> String {
        let each: Vec<String> =
            self.iter().map(|(joint, value)| format!("{joint} {value:.decimals$}")).collect();
        each.join(", ")
    }
}

impl Serialize for ByJoint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

/// A joint with its position.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NamedValue {
    /// The joint.
    pub joint: String,
    /// Its position, rad or m.
    pub value: f64,
}

/// Joint positions as a map from names.
///
/// # Errors
/// What the serializer says.
pub fn as_map<S: Serializer>(values: &[NamedValue], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(values.iter().map(|named| (&named.joint, named.value)))
}
