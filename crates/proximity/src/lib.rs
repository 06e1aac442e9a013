//! Distances of links from each other, from obstacles and from forbidden zones, along a run ([`Clearance`]) or at given
//! configurations (`distances`); and obstacles that move. Only `hulls/` names parry.

mod bodies;
mod clearance;
pub mod codes;
mod constant_pairs;
mod disabled_pairs;
mod disabled_srdf;
mod distances;
mod error;
mod hulls;
mod pair_names;
mod pairs;
mod penetration;
mod points;
mod separation;
mod simplified_hulls;
mod travel;
mod waiting;
mod zone;

pub use bodies::{BodyTrack, Grasp, MovingBodies, MovingBody, PathPose};
pub use clearance::{Clearance, Nearest};
pub use disabled_pairs::{
    ALWAYS_SHARE, DeclaredPairs, DisableReason, DisabledPairs, SuggestedPair, suggest_disabled,
};
pub use disabled_srdf::srdf_text;
pub use distances::{
    BelowLimit, DistanceError, DistanceList, DistanceOptions, DistanceReport, Distances, Overlap, distances,
};
pub use error::ProximityError;
pub use hulls::Hulls;
pub use pair_names::{PairFault, PairNames, matches};
pub use pairs::{Carried, ObstacleMobility, Pair, PairChoice, measured_pairs};
pub use simplified_hulls::simplified_hulls;
pub use zone::Zone;
