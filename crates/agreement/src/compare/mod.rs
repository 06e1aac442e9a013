//! Sources of link poses against each other: without motion, configuration by configuration, and as chains of
//! screws over the whole joint range.

pub mod basics;
pub mod certificate;
pub mod check;
pub(crate) mod identified;
pub mod model;
