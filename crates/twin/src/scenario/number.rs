//! Numbers that are checked as they are read, so that the error stands at the value.

use serde::{Deserialize, Deserializer, de::Error};

/// A finite number.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Finite(f64);

/// A finite number above zero.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Positive(f64);

/// A finite number, zero or above.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct NonNegative(f64);

macro_rules! checked_number {
    ($name:ident, $expected:literal, $holds:expr) => {
        impl $name {
            /// The number.
            pub fn get(self) -> f64 {
                self.0
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let value = f64::deserialize(deserializer)?;
                let holds: fn(f64) -> bool = $holds;
                if value.is_finite() && holds(value) {
                    Ok(Self(value))
                } else {
                    Err(D::Error::custom(format!("expected {}, found {value}", $expected)))
                }
            }
        }
    };
}

checked_number!(Finite, "a finite number", |_| true);
checked_number!(Positive, "a finite number above 0", |value| value > 0.0);
checked_number!(NonNegative, "a finite number, 0 or above", |value| value >= 0.0);
