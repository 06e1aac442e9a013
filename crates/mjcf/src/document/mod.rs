//! The elements of an MJCF with their places, included files in place.

mod assemble;
mod element;

pub(crate) use assemble::{Assembly, assemble, folder};
pub(crate) use element::{MjAttribute, MjElement};
