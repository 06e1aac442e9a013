//! Contact of links with obstacles: their shapes, and which of them rapier has to look at closely.

pub(crate) mod ellipsoid;
pub(crate) mod left_out;
pub(crate) mod near;
pub(crate) mod shapes;
