//! How far links are apart from each other, from obstacles and from forbidden zones. Only `hulls.rs` names parry.

mod clearance;
mod distances;
mod hulls;

pub use clearance::{Clearance, Nearest, Pair, PairChoice};
pub use distances::{DistanceError, DistanceReport, Distances, Overlap, distances};
pub use hulls::{Hulls, ProximityError};
