//! What the digits of the files allow: two models agree within the digits if there are values, each within half of
//! the last place of the typed one, with which they are the same (`nearest.rs`). Fits count differences that the
//! digits can explain as small (`weights.rs`).

mod nearest;
mod typed_value;
mod weights;
mod written_alike;
mod written_digits;

pub(super) use nearest::most_norm;
pub(super) use weights::Weights;
pub(crate) use written_alike::tie_written_alike;

pub use typed_value::{TransformPart, TypedPlace, TypedValue};
pub use written_digits::WrittenDigits;
