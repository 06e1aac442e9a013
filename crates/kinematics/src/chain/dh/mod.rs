//! Denavit-Hartenberg: the two conventions, and chains of rows. There is no plain `Dh`: the same
//! table under the other convention is another robot.

pub(crate) mod chain;
pub(crate) mod conditions;
pub(crate) mod derivatives;
mod derive;
pub(crate) mod modified;
#[cfg(test)]
mod rows;
pub(crate) mod serial;
pub(crate) mod standard;

pub use chain::{DhChain, DhFrames};
pub use conditions::NotADhTransform;
pub use derivatives::{DhDerivatives, DhRowTwists};
pub use derive::{
    AxisPair, AxisRelation, Choice, DeriveError, DhDerivation, FreeChoice, ROUNDED_M, ROUNDED_RAD,
    RoundedPair, derive_dh, without_rounding,
};
pub use modified::ModifiedDh;
pub use serial::SerialDh;
pub use standard::StandardDh;
