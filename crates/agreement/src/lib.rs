//! Are two sources of link poses the same robot, and if not, why?
//!
//! [`compare`] compares table, URDF chain, screws and one more source of link poses at configurations,
//! [`diagnosis`] finds the cause of a difference, [`bound`] bounds the distance of two chains over the
//! whole joint range, and [`report`] gives a diagnosis in names, lines and values of the robot file.
//!
//! The physics is not part of this crate: it is handed in as [`congruent_kinematics::LinkPoses`].

pub mod compare;
pub mod diagnosis;
pub mod report;
mod source_pair;

pub use congruent_pose_bound as bound;
pub use source_pair::SourcePair;
