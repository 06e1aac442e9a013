//! What all pages are made of.

mod badge;
mod bar;
mod diagnosis;
mod document;
mod lines;
mod plot;
mod provenance;
mod unit_column;
mod value;
mod warnings;

pub(crate) use badge::{BadgeKind, badge};
pub(crate) use bar::{BarScale, UsedShare};
pub(crate) use diagnosis::diagnosis;
pub(crate) use document::{capitalised, document};
pub(crate) use lines::changed;
pub(crate) use plot::plot;
pub(crate) use provenance::{Provenance, provenance};
pub(crate) use unit_column::UnitColumn;
pub(crate) use value::{Pointer, count, value};
pub(crate) use warnings::warnings;
