//! Commands about recordings, and the viewer that shows them.

pub(crate) mod inspect;
mod inspected_files;
mod inspected_suite;
pub(crate) mod live;
pub(crate) mod view;
pub(crate) mod viewer;
