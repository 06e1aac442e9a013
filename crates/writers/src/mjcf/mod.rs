//! A robot as MJCF.

mod assets;
mod body;
mod names;
mod plan;
mod text;

pub(crate) use names::fit_names;
pub(crate) use plan::{LEAST, bodies, has_mass, keeps_frame};
pub(crate) use text::{excluded_bodies, mjcf_text};

/// Ranges from here on are no limits to the reader of MJCF. Unit: rad or m; kind: range of numbers.
pub(crate) const UNLIMITED: f64 = 1e30;

/// The name of the world, which is the root of every MJCF.
pub(crate) const WORLD: &str = "world";
