//! Maps from names to values in JSON in which no name may appear twice: by the standard the last one would win.

use std::{collections::BTreeMap, fmt};

use serde::{
    Deserializer,
    de::{Error, MapAccess, Visitor},
};

/// Reads a map of names to numbers; for `#[serde(deserialize_with = "unique_names")]`.
///
/// # Errors
/// A name is given twice.
/// # Examples
/// ```
/// use std::collections::BTreeMap;
/// use congruent_configurations::unique_names;
/// let read = |text: &str| unique_names(&mut serde_json::Deserializer::from_str(text));
/// assert_eq!(read(r#"{"a": 1}"#).unwrap(), BTreeMap::from([("a".to_owned(), 1.0)]));
/// assert!(read(r#"{"a": 1, "a": 2}"#).unwrap_err().to_string().starts_with(r#""a" is given twice"#));
/// ```
pub fn unique_names<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, f64>, D::Error> {
    deserializer.deserialize_map(UniqueNames)
}

struct UniqueNames;

impl<'de> Visitor<'de> for UniqueNames {
    type Value = BTreeMap<String, f64>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of names to numbers")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut map = BTreeMap::new();
        while let Some((name, value)) = entries.next_entry::<String, f64>()? {
            if map.contains_key(&name) {
                return Err(A::Error::custom(format!("\"{name}\" is given twice")));
            }
            map.insert(name, value);
        }
        Ok(map)
    }
}
