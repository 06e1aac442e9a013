//! A robot as MJCF.

mod assets;
mod body;
mod names;
mod plan;
mod text;
mod world;

pub(crate) use names::fit_names;
pub(crate) use plan::{LEAST, bodies, has_mass, keeps_frame};
pub(crate) use text::{excluded_bodies, mjcf_text};
pub(crate) use world::UNLIMITED;
