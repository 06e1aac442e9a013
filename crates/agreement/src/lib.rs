//! Are two sources of link poses the same robot, and if not, why?
//!
//! [`compare`] holds table, URDF chain, screws and one more source of link poses against each other,
//! [`diagnosis`] finds the cause of a difference, [`bound`] says how far two chains are apart at most over
//! the whole joint range, and [`report`] tells it in names, lines and values of the robot file.
//!
//! The physics is no part of this crate: it is handed in as [`congruent_kinematics::LinkPoses`].

pub mod bound;
pub mod compare;
pub mod diagnosis;
pub mod report;
