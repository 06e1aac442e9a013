//! Values as files write them: arrays, numbers, rotations and transforms, and TOML text as a whole.

pub(crate) mod array;
pub(crate) mod name;
pub(crate) mod number;
pub(crate) mod rpy;
pub mod toml_text;
pub(crate) mod transform;
