//! `congruent describe`: what a robot's files say, and what they leave open for which use.

mod parts;
mod summary;
mod uses;

pub use parts::{JointSummary, LinkSummary, MeshSummary, MimicSummary, ShapeSummary};
pub use summary::{DescriptionSummary, LikelyTip, TableSummary, describe};
pub use uses::{Missing, UseSummary};
