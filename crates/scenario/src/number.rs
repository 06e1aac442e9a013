//! Numbers that are checked as they are read, so that the error has the place of the value.

use serde::{Deserialize, Deserializer, de::Error};

/// The range that a number must be in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Neither infinite nor NaN.
    Finite,
    /// Finite and above 0.
    Positive,
    /// Finite, 0 or above.
    NonNegative,
    /// 0 to 1.
    Share,
    /// Above 0 and below 1.
    InnerShare,
}

impl Range {
    /// Whether a number is in it.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => value > 0.0,
                Self::NonNegative => value >= 0.0,
                Self::Share => (0.0..=1.0).contains(&value),
                Self::InnerShare => value > 0.0 && value < 1.0,
            }
    }

    /// The range in words, for a message.
    pub fn words(self) -> &'static str {
        match self {
            Self::Finite => "a finite number",
            Self::Positive => "a finite number above 0",
            Self::NonNegative => "a finite number, 0 or above",
            Self::Share => "a number from 0 to 1",
            Self::InnerShare => "a number above 0 and below 1, such as 0.99 for 99 %",
        }
    }

    fn read<'de, D: Deserializer<'de>>(self, deserializer: D) -> Result<f64, D::Error> {
        self.check(f64::deserialize(deserializer)?)
    }

    fn read_array<'de, D: Deserializer<'de>, const N: usize>(
        self,
        deserializer: D,
    ) -> Result<[f64; N], D::Error> {
        let entries = Vec::<f64>::deserialize(deserializer)?;
        let found = entries.len();
        let wrong_length = |_| D::Error::custom(format!("expected an array of {N}, found {found} entries"));
        let entries: [f64; N] = entries.try_into().map_err(wrong_length)?;
        entries.iter().try_for_each(|&entry| self.check(entry).map(|_| ()))?;
        Ok(entries)
    }

    fn check<E: Error>(self, value: f64) -> Result<f64, E> {
        if self.contains(value) {
            return Ok(value);
        }
        Err(E::custom(format!("expected {}, found {value}", self.words())))
    }
}

/// For `deserialize_with`: a share, if it is there.
pub(crate) fn optional_share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    Range::Share.read(deserializer).map(Some)
}

/// For `deserialize_with`: a share without its ends.
pub(crate) fn inner_share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Range::InnerShare.read(deserializer)
}

/// For `deserialize_with`: a share without its ends, if it is there.
pub(crate) fn optional_inner_share<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<f64>, D::Error> {
    inner_share(deserializer).map(Some)
}

/// For `deserialize_with`: a number, not infinite and not NaN.
pub(crate) fn finite<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Range::Finite.read(deserializer)
}

/// For `deserialize_with`: the same, if it is there.
pub(crate) fn optional_finite<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    Range::Finite.read(deserializer).map(Some)
}

/// For `deserialize_with`: a number in the range of the name.
pub(crate) fn positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Range::Positive.read(deserializer)
}

/// For `deserialize_with` of an optional key: a number in the range of the name.
pub(crate) fn optional_positive<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    positive(deserializer).map(Some)
}

/// For `deserialize_with`: a number in the range of the name.
pub(crate) fn non_negative<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Range::NonNegative.read(deserializer)
}

/// For `deserialize_with`: a number from 0 to 1.
pub(crate) fn share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Range::Share.read(deserializer)
}

/// For `deserialize_with` of an optional key: a number in the range of the name.
pub(crate) fn optional_non_negative<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<f64>, D::Error> {
    non_negative(deserializer).map(Some)
}

/// For `deserialize_with`: exactly `N` finite numbers.
pub(crate) fn finite_array<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<[f64; N], D::Error> {
    Range::Finite.read_array(deserializer)
}

/// For `deserialize_with`, of a key that may be left out: exactly `N` positive numbers.
pub(crate) fn optional_positive_array<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<Option<[f64; N]>, D::Error> {
    Range::Positive.read_array(deserializer).map(Some)
}

/// For `deserialize_with`, of a key that may be left out: exactly `N` numbers; whether they are finite is
/// checked with the transform that they belong to.
pub(crate) fn optional_array<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<Option<[f64; N]>, D::Error> {
    let entries = Vec::<f64>::deserialize(deserializer)?;
    let found = entries.len();
    let wrong_length = |_| D::Error::custom(format!("expected an array of {N}, found {found} entries"));
    entries.try_into().map(Some).map_err(wrong_length)
}
