//! Commands about recordings.

pub(crate) mod inspect;
mod inspect_text;
