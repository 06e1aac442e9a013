//! The grammar of MJCF: which elements, attributes and values MuJoCo accepts, and the check of a tree against it.

mod check;
mod numbers;
mod orientations;
mod schema;

pub(crate) use check::check;
pub(crate) use numbers::numbers;
pub(crate) use orientations::ORIENTATIONS;
