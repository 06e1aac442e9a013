//! The XML of a document against the grammar of URDF.

mod check;
mod number;
mod rules;

pub(super) use check::check;
