//! How far links are apart from each other, from obstacles and from forbidden zones. Only `hulls.rs` names parry.

mod clearance;
mod cut_hulls;
mod disabled_pairs;
mod disabled_srdf;
mod distances;
mod hulls;
mod pair_names;
mod pairs;
mod travel;
mod waiting;

pub use clearance::{Clearance, Nearest};
pub(crate) use cut_hulls::cut_hulls;
pub use disabled_pairs::{
    ALWAYS_SHARE, DeclaredPairs, DisableReason, DisabledPairs, SuggestedPair, suggest_disabled,
};
pub use disabled_srdf::srdf_text;
pub use distances::{
    BelowLimit, DistanceError, DistanceList, DistanceOptions, DistanceReport, Distances, Overlap, distances,
};
pub use hulls::{Hulls, ProximityError};
pub(crate) use pair_names::matches;
pub use pair_names::{PairFault, PairNames};
pub use pairs::{Carried, ObstacleMobility, Pair, PairChoice, measured_pairs};
