//! What the reader of MJCF takes for the world, and for no limit.

/// Ranges from here on are no limits to the reader of MJCF. Unit: rad or m; kind: range of numbers.
pub(crate) const UNLIMITED: f64 = 1e30;

/// The name of the world, which is the root of every MJCF.
pub(super) const WORLD: &str = "world";
