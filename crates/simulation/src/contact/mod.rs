//! Contact of links with obstacles: which shapes there are, and which of them rapier has to look at.

pub(crate) mod near;
pub(crate) mod shapes;
