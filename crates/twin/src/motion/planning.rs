//! What the plan of a motion may look at.

use congruent_description::{Diagnostic, RobotDescription, RobotQ};

use crate::scenario::Place;

/// The robot, where the motion starts, and where it is written.
pub(super) struct Planning<'a> {
    pub(super) description: &'a RobotDescription,
    /// Where the motion before it ends; before a motion that needs no start, the last configuration that is
    /// known.
    pub(super) from: &'a RobotQ,
    pub(super) place: Place<'a>,
    pub(super) warnings: &'a mut Vec<Diagnostic>,
}
