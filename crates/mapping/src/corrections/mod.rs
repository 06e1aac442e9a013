//! Two URDFs with the same moving joints: which joint's origin or axis is another one?
//!
//! Both files give every frame, so nothing is searched: in matched links (`MatchedRobots`) the origin and the axis that a
//! joint has in the other file follow from its poses at zero (`correction.rs`). Which of them matter is decided by the
//! poses alone (`explained.rs`): the fewest corrections, the largest first, after which all links agree. If frames lie
//! elsewhere in their links as well, one displacement that brings all screws and the tip into agreement is searched
//! (`displacement.rs`).

mod compared_at;
mod correction;
mod displacement;
mod explained;

pub use compared_at::ComparedAt;
pub use correction::{JointCorrection, JointPart};
pub use explained::{ExplainedByJoints, explained_by_joints};
