//! Commands about recordings, and the viewer that shows them.

pub(crate) mod inspect;
mod inspect_text;
pub(crate) mod live;
pub(crate) mod view;
pub(crate) mod viewer;
