//! The arrangement of the viewer's panels and views, which rerun calls a blueprint.

mod joints;
pub(crate) mod layout;
mod plots;
mod texts;
mod tree;
