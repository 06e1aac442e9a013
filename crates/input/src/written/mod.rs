//! Values as files write them: arrays, numbers, rotations and transforms, mistakes of who types them, and TOML text as a
//! whole.

mod advice;
pub(crate) mod array;
pub(crate) mod digits;
pub(crate) mod distinct_overrides;
pub(crate) mod name;
pub mod number;
mod number_mistake;
pub(crate) mod numbers_at;
pub(crate) mod overrides;
pub(crate) mod rpy;
pub(crate) mod serde_message;
pub(crate) mod toml_literal;
pub mod toml_text;
pub(crate) mod transform;
pub(crate) mod typing_error;
mod unclosed;
pub(crate) mod wrong_unit;
pub use rpy::{rotation_from_rpy_fixed_xyz, rpy_fixed_xyz_rad};
pub use serde_message::in_words as serde_in_words;
