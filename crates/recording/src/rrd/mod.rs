//! The file: its messages, identifiers, entity paths and timelines. What is recorded is decided elsewhere.

pub(crate) mod convert;
pub(crate) mod identity;
pub(crate) mod paths;
pub(crate) mod times;
pub(crate) mod writer;
