//! Names and lists of names that are checked as they are read, so that the error names the expected form.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{DeserializeOwned, Error, IntoDeserializer, SeqAccess, Visitor},
};

/// For `deserialize_with`: the name of a variant.
pub(crate) fn variant<'de, D: Deserializer<'de>, T: DeserializeOwned>(
    deserializer: D,
) -> Result<T, D::Error> {
    T::deserialize(String::deserialize(deserializer)?.into_deserializer())
}

/// For `deserialize_with`: the name of a variant, if it is there.
pub(crate) fn optional_variant<'de, D: Deserializer<'de>, T: DeserializeOwned>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    variant(deserializer).map(Some)
}

/// For `deserialize_with`: an array of strings.
pub(crate) fn strings<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    deserializer.deserialize_seq(Strings)
}

/// For `deserialize_with`: two strings, no more and no less.
pub(crate) fn two_strings<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[String; 2], D::Error> {
    let strings = strings(deserializer)?;
    let found = strings.len();
    strings.try_into().map_err(|_| Error::custom(format!("expected two names, found {found}")))
}

struct Strings;

impl<'de> Visitor<'de> for Strings {
    type Value = Vec<String>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("an array of strings")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut strings = Vec::new();
        while let Some(entry) = entries.next_element()? {
            strings.push(entry);
        }
        Ok(strings)
    }
}
