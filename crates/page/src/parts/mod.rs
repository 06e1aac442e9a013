//! What all pages are made of.

mod badge;
mod diagnosis;
mod document;
mod lines;
mod plot;
mod value;
mod warnings;

pub(crate) use badge::{BadgeKind, badge};
pub(crate) use diagnosis::diagnosis;
pub(crate) use document::{capitalised, document};
pub(crate) use lines::changed;
pub(crate) use plot::plot;
pub(crate) use value::{Pointer, count, value};
pub(crate) use warnings::warnings;
