//! Screws: a chain and a tree by products of exponentials, and what their values do to the tip.

pub(crate) mod chain;
pub(crate) mod derivatives;
pub(crate) mod tree;
