//! The XML of a document against the grammar of URDF.

mod check;
mod misspelt;
mod number;
mod rules;

pub(super) use check::check;
pub use misspelt::{Misspelling, Misspelt, misspellings};
