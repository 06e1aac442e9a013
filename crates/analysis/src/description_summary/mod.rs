//! `congruent describe`: the contents of a robot's files, and what is missing for which use.

mod orders;
mod parts;
mod summary;
mod uses;

pub use orders::{JointOrders, joint_orders};
pub use parts::{JointSummary, LinkSummary, MeshSummary, MimicSummary, ShapeSummary};
pub use summary::{DescriptionSummary, LikelyTip, TableSummary, describe};
pub use uses::{Missing, UseSummary};
