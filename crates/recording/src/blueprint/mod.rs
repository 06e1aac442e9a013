//! The arrangement of the viewer's panels and views, which rerun calls a blueprint.

pub(crate) mod layout;
mod tree;
